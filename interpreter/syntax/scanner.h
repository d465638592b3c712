// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/diagnostic.h"
#include "syntax/rule_parser.h"

namespace gmsim::syntax {

/// A token as read; its text is that of its place.
struct Token {
  RuleParser::token_kind_type kind = RuleParser::token::END;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  bool first_on_line = false;
  bool in_first_column = false;
};

/// Any word: a name, a reserved word or a contextual one.
[[nodiscard]] bool is_word(RuleParser::token_kind_type kind);
[[nodiscard]] bool is_reserved(RuleParser::token_kind_type kind);

/// A piece of source text for a message: a very long one only in its beginning.
[[nodiscard]] std::string shortened(std::string_view text);

/// Cuts a text into tokens, ended by END. The patterns are those of grammar/rule_lexer.ll, whose
/// actions call the functions below with the place of what they matched already known.
class Scanner {
 public:
  /// Receives what is wrong with the text; returns false to stop the scan.
  using Report = std::function<bool(support::Diagnostic)>;

  Scanner(support::FileId file, std::string_view text, Report report);

  [[nodiscard]] const std::vector<Token>& tokens() const { return tokens_; }
  /// The `///` lines right above the token that begins at an offset.
  [[nodiscard]] std::string doc_above(std::uint32_t begin) const;

  // ---- called by the lexer's actions ----
  void advance(int length);
  void end_line() { first_on_line_ = true; }
  void add(RuleParser::token_kind_type kind);
  void doc_line();
  void comment();
  void open_comment();
  void bad_number();
  void string();
  void bad_string();
  void open_string();
  void bad_character();

 private:
  void run(std::string_view text);  // defined by the lexer
  [[nodiscard]] Span place() const { return {file_, begin_, end_}; }
  [[nodiscard]] std::string_view matched() const { return text_.substr(begin_, end_ - begin_); }
  void report(support::DiagnosticKind kind, Span place, std::string message, std::string help = {});
  /// Reports the first byte of the matched text that is zero or no UTF-8; false if there is one.
  bool check_bytes();

  support::FileId file_;
  std::string_view text_;
  Report report_;
  bool stopped_ = false;
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
  bool first_on_line_ = true;
  std::string pending_doc_;
  std::vector<std::pair<std::uint32_t, std::string>> docs_;
  std::vector<Token> tokens_;
};

}  // namespace gmsim::syntax
