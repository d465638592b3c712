// SPDX-License-Identifier: MIT
#include "syntax/token_stream.h"

namespace gmsim::syntax {

using token = RuleParser::token;

TokenStream::TokenStream(const std::vector<Token>& tokens, RuleParser::token_kind_type start)
    : tokens_(tokens), pending_{Token{.kind = start}} {}

Token TokenStream::next() {
  closed_.reset();
  last_is_virtual_ = !pending_.empty();
  if (last_is_virtual_) {
    last_ = pending_.back();
    pending_.pop_back();
  } else {
    last_ = tokens_[position_];
    if (last_.kind != token::END) ++position_;
  }
  if (last_.kind == token::LBRACE) open_.push_back(last_);
  if (last_.kind == token::RBRACE && !open_.empty()) {
    closed_ = open_.back();
    open_.pop_back();
  }
  return last_;
}

const Token* TokenStream::before_last() const {
  const std::size_t after = last_.kind == token::END || last_is_virtual_ ? 0 : 1;
  return position_ > after ? &tokens_[position_ - after - 1] : nullptr;
}

bool TokenStream::begins_item(std::size_t i) const {
  if (i == end()) return false;
  const Token& next = tokens_[i + 1];
  switch (tokens_[i].kind) {
    case token::IMPORT:
      return next.kind == token::STRING;
    case token::DIMENSION:
      return next.kind == token::INTEGER && open_.empty();
    case token::ORBIT:
    case token::EMBEDDING:
    case token::DERIVED:
    case token::FUNCTION:
    case token::PATTERN:
    case token::RULE:
    case token::INTERACTION:
    case token::EXTERNAL:
    case token::FAMILY:
    case token::CRITERION:
    case token::OPERATION:
      return is_word(next.kind);
    default:
      return false;
  }
}

bool TokenStream::begins_statement(std::size_t i, bool is_wrong) const {
  switch (tokens_[i].kind) {
    // Words that seldom begin a continued line.
    case token::LEFT:
    case token::RIGHT:
    case token::MATCH:
    case token::PARAM:
    case token::LET:
    case token::ENERGY:
    case token::FORCE:
    case token::RESULT:
    case token::FOR:
    case token::APPLY:
      return true;
    // Words that may, but do not where they are wrong.
    case token::WHERE:
    case token::VALUE:
    case token::FIRST:
      return is_wrong;
    default:
      return false;
  }
}

/// Puts the last token back, as if it had not been handed out.
void TokenStream::take_back_last() {
  if (last_is_virtual_ || last_.kind == token::END) return;
  --position_;
  if (last_.kind == token::LBRACE) open_.pop_back();
  if (closed_) open_.push_back(*closed_);
}

/// Where the damage that begins at token `from` ends: after the `;` or block that ends the
/// statement, before the `}` that ends the block around it, or before what can only be the next
/// statement or item.
std::size_t TokenStream::end_of_damage(std::size_t from) const {
  const bool in_item = !open_.empty();
  int depth = 0;
  for (std::size_t i = from; i < end(); ++i) {
    const Token& at = tokens_[i];
    if (at.in_first_column && begins_item(i)) return i;
    if (depth == 0 && at.first_on_line &&
        (in_item ? begins_statement(i, i == from) : begins_item(i)))
      return i;
    if (at.kind == token::LBRACE) ++depth;
    if (at.kind == token::SEMICOLON && depth == 0) return i + 1;
    if (at.kind == token::RBRACE) {
      if (depth == 0) return in_item ? i : i + 1;
      if (--depth == 0 && tokens_[i + 1].kind != token::ELSE) return i + 1;
    }
  }
  return end();
}

void TokenStream::resynchronize() {
  take_back_last();
  pending_.clear();
  // An item inside of another is noticed only behind its first word, which could be a name.
  const bool behind_item = position_ > 0 && !open_.empty() &&
                           tokens_[position_ - 1].in_first_column && begins_item(position_ - 1);
  if (behind_item) --position_;
  const bool at_end = position_ == end();
  if (at_end && last_resumed_ == end()) return;  // the parser gives up when it sees END again
  // Going on twice at one place would never end.
  const std::size_t from = last_resumed_ == position_ ? position_ + 1 : position_;
  position_ = stopped_ ? end() : end_of_damage(from);
  last_resumed_ = position_;
  const Token& resumed = tokens_[position_];
  const bool leaves_item =
      position_ == end() || (resumed.in_first_column && begins_item(position_));
  const Token brace{.kind = token::RBRACE, .begin = resumed.begin, .end = resumed.begin};
  if (leaves_item) pending_.assign(open_.size(), brace);
  pending_.push_back({.kind = token::RECOVERED, .begin = resumed.begin, .end = resumed.begin});
}

}  // namespace gmsim::syntax
