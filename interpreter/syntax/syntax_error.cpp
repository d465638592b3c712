// SPDX-License-Identifier: MIT
#include "syntax/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <initializer_list>
#include <string>

#include "support/suggest.h"

namespace gmsim::syntax {
namespace {

using support::Diagnostic;
using support::DiagnosticKind;
using Kind = RuleParser::token_kind_type;
using token = RuleParser::token;

/// Of a longer list only the beginning is shown.
constexpr std::size_t kLongestList = 9;

std::string spelling(Kind kind) {
  return RuleParser::symbol_name(static_cast<RuleParser::symbol_kind_type>(kind));
}

std::string quoted(Kind kind) {
  return fmt::format("`{}`", spelling(kind));
}

bool is_keyword(Kind kind) {
  return is_word(kind) && kind != token::NAME;
}

/// The tokens that could stand at a place.
class ExpectedSet {
 public:
  explicit ExpectedSet(const std::vector<RuleParser::symbol_kind_type>& kinds) {
    for (const auto kind : kinds) set_.set(static_cast<std::size_t>(kind));
  }
  [[nodiscard]] bool has(Kind kind) const { return set_.test(static_cast<std::size_t>(kind)); }
  [[nodiscard]] bool has_only(std::initializer_list<Kind> kinds) const {
    const auto is_there = [&](Kind kind) { return has(kind); };
    return set_.count() == kinds.size() && std::all_of(kinds.begin(), kinds.end(), is_there);
  }
  void remove(std::initializer_list<Kind> kinds) {
    for (const Kind kind : kinds) set_.reset(static_cast<std::size_t>(kind));
  }
  void remove_words() {
    for (const Kind kind : kinds())
      if (is_word(kind)) remove({kind});
  }
  [[nodiscard]] std::vector<Kind> kinds() const {
    std::vector<Kind> found;
    for (std::size_t i = 0; i < set_.size(); ++i)
      if (set_.test(i)) found.push_back(static_cast<Kind>(i));
    return found;
  }

  // Where are we? Words alone do not tell, since most of them can be names.
  [[nodiscard]] bool is_statement() const { return has(token::LET) && has(token::RBRACE); }
  [[nodiscard]] bool is_item() const { return has(token::IMPORT) && has(token::END); }
  [[nodiscard]] bool is_expression() const { return has(token::INTEGER) && has(token::TRUE); }
  [[nodiscard]] bool is_after_operand() const { return has(token::TIMES) && has(token::PLUS); }
  [[nodiscard]] bool is_name() const { return has(token::NAME); }

 private:
  std::bitset<256> set_;
};

std::vector<Kind> statement_words(ItemKind item) {
  switch (item) {
    case ItemKind::Rule:
      return {token::LEFT, token::RIGHT, token::WHERE, token::PARAM, token::LET, token::DIMENSION};
    case ItemKind::Interaction:
      return {token::MATCH, token::PARAM, token::LET,    token::ENERGY,
              token::FORCE, token::FIRST, token::RESULT, token::DIMENSION};
    case ItemKind::Criterion:
      return {token::MATCH, token::PARAM,  token::LET,   token::WHERE,
              token::VALUE, token::RESULT, token::APPLY, token::DIMENSION};
    case ItemKind::Operation:
      return {token::LET, token::PARAM, token::FOR, token::IF, token::APPLY, token::DIMENSION};
  }
  return {};
}

bool has_assignments(ItemKind item) {
  return item == ItemKind::Rule || item == ItemKind::Operation;
}

std::vector<std::string> statement_names(ItemKind item) {
  std::vector<std::string> names;
  for (const Kind kind : statement_words(item)) names.push_back(quoted(kind));
  if (has_assignments(item)) names.push_back("an assignment");
  return names;
}

/// The expected tokens in the words of a user, grouped where they would be many.
std::vector<std::string> expected_names(ExpectedSet set, ItemKind item) {
  std::vector<std::string> names;
  if (set.is_statement()) {
    names = statement_names(item);
    set.remove_words();
  } else if (set.is_item()) {
    names = {"`rule`", "`interaction`", "`function`", "`import`", "another item"};
    set.remove_words();
    set.remove({token::END});
  } else if (set.is_expression()) {
    names = {"an expression"};
    set.remove_words();
    set.remove({token::INTEGER, token::REAL, token::LPAREN, token::LESS, token::MINUS});
  } else if (set.is_name()) {
    names = {set.has(token::LESS) && !set.is_after_operand() ? "an orbit" : "a name"};
    set.remove_words();
    set.remove({token::LESS});
  }
  if (set.is_after_operand()) {
    names.push_back("an operator");
    set.remove({token::PLUS, token::MINUS, token::TIMES, token::DIVIDE, token::POWER, token::DOT,
                token::AT, token::LPAREN, token::LBRACKET, token::LESS, token::LESS_EQUAL,
                token::GREATER, token::GREATER_EQUAL, token::EQUAL, token::NOT_EQUAL, token::AND,
                token::OR, token::IN});
  }
  for (const Kind kind : set.kinds()) {
    if (kind == token::INTEGER)
      names.push_back("a whole number");
    else if (kind == token::REAL)
      names.push_back("a number");
    else if (kind == token::STRING)
      names.push_back("a string");
    else if (kind == token::END)
      names.push_back("the end");
    else
      names.push_back(quoted(kind));
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool last = i + 1 == names.size();
    if (names.size() > kLongestList && i + 2 >= kLongestList && !last) continue;
    if (i > 0 && last)
      text += names.size() > kLongestList ? ", … or " : " or ";
    else if (i > 0)
      text += ", ";
    text += names[i];
  }
  return text;
}

/// Builds the message for one unexpected token.
class Describer {
 public:
  explicit Describer(const UnexpectedToken& unexpected)
      : unexpected_(unexpected), expected_(unexpected.expected) {}

  [[nodiscard]] Diagnostic describe() const {
    if (lacks_semicolon()) return missing_semicolon();
    if (misspells_statement()) return unknown_statement();
    const Token& found = unexpected_.found;
    const auto names = expected_names(expected_, unexpected_.item);
    Diagnostic diagnostic = unexpected(found, names);
    diagnostic.help = help_for(found);
    if (found.kind == token::END && unexpected_.open_block != nullptr)
      diagnostic.related.push_back({place(*unexpected_.open_block), "this block is not closed"});
    return diagnostic;
  }

 private:
  [[nodiscard]] Span place(const Token& at) const { return {unexpected_.file, at.begin, at.end}; }
  [[nodiscard]] std::string text(const Token& at) const {
    return std::string(unexpected_.text.substr(at.begin, at.end - at.begin));
  }

  [[nodiscard]] std::string named(const Token& at) const {
    if (at.kind == token::END) return "end of text";
    if (at.kind == token::STRING) return "string";
    const char* what = at.kind == token::NAME                                ? "name "
                       : is_reserved(at.kind)                                ? "reserved word "
                       : at.kind == token::INTEGER || at.kind == token::REAL ? "number "
                                                                             : "";
    return fmt::format("{}`{}`", what, shortened(text(at)));
  }

  [[nodiscard]] Diagnostic unexpected(const Token& at,
                                      const std::vector<std::string>& names) const {
    return {.kind = DiagnosticKind::Syntax,
            .message = fmt::format("unexpected {}{}{}", named(at),
                                   names.empty() ? "" : "; expected ", listed(names)),
            .place = place(at)};
  }

  /// Is what was found the beginning of something else, so that only the end is missing?
  [[nodiscard]] bool lacks_semicolon() const {
    const Token& found = unexpected_.found;
    const bool begins_anew = (found.first_on_line && is_word(found.kind)) ||
                             found.kind == token::RBRACE || found.kind == token::END;
    return expected_.has(token::SEMICOLON) && unexpected_.before != nullptr && begins_anew;
  }
  [[nodiscard]] Diagnostic missing_semicolon() const {
    const std::uint32_t end = unexpected_.before->end;
    return {.kind = DiagnosticKind::Syntax,
            .message = "expected `;`",
            .place = Span{unexpected_.file, end, end}};
  }

  /// A word that begins a statement and is not followed by `.` may be meant as another word.
  [[nodiscard]] bool misspells_statement() const {
    if (!expected_.has_only({token::DOT, token::AT}) || unexpected_.before == nullptr) return false;
    const Token& found = unexpected_.found;
    return found.kind == token::LBRACE || found.kind == token::ASSIGN || !meant().empty() ||
           is_keyword(unexpected_.before->kind) || leaves_block_open();
  }
  [[nodiscard]] std::string meant() const {
    std::vector<std::string> words;
    for (const Kind kind : statement_words(unexpected_.item)) words.push_back(spelling(kind));
    return support::did_you_mean(text(*unexpected_.before), words);
  }
  [[nodiscard]] Diagnostic unknown_statement() const {
    const Token& before = *unexpected_.before;
    auto names = statement_names(unexpected_.item);
    names.push_back("`}`");
    Diagnostic diagnostic = unexpected(before, names);
    diagnostic.help = meant();
    if (diagnostic.help.empty() && unexpected_.found.kind == token::ASSIGN)
      diagnostic.help = fmt::format("a value gets a name by `let {} = …;`", text(before));
    if (leaves_block_open())
      diagnostic.related.push_back({place(*unexpected_.open_block), "this block is not closed"});
    return diagnostic;
  }

  /// Does the word stand where items do?
  [[nodiscard]] bool leaves_block_open() const {
    return unexpected_.before->in_first_column && unexpected_.open_block != nullptr;
  }

  [[nodiscard]] std::string help_for(const Token& found) const {
    if (found.kind == token::NAME) return close_keyword(found);
    if (found.kind == token::DOT && (expected_.is_expression() || follows_number()))
      return "a number has digits on both sides of its point, as in `0.5`";
    if (found.kind == token::ASSIGN && expected_.has(token::EQUAL)) return "equality is `==`";
    if (found.kind == token::GREATER_EQUAL && expected_.has(token::GREATER))
      return "put a blank between `>` and `=`";
    const bool compares = found.kind >= token::LESS && found.kind <= token::NOT_EQUAL;
    if (compares && expected_.is_after_operand())
      return "comparisons do not chain: write `a < b and b < c`";
    return {};
  }
  [[nodiscard]] bool follows_number() const {
    const Token* before = unexpected_.before;
    return before != nullptr && before->kind == token::INTEGER &&
           before->end == unexpected_.found.begin;
  }
  [[nodiscard]] std::string close_keyword(const Token& found) const {
    std::vector<std::string> words;
    for (const Kind kind : expected_.kinds())
      if (is_keyword(kind)) words.push_back(spelling(kind));
    return support::did_you_mean(text(found), words);
  }

  const UnexpectedToken& unexpected_;
  ExpectedSet expected_;
};

}  // namespace

Diagnostic describe(const UnexpectedToken& unexpected) {
  return Describer(unexpected).describe();
}

}  // namespace gmsim::syntax
