// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "syntax/scanner.h"

namespace gmsim::syntax {

/// Hands the tokens of a text to the parser. After an error it chooses where parsing goes on, and
/// gives the parser RECOVERED in place of what is skipped; blocks that the text leaves open are
/// closed by `}` tokens of no length.
class TokenStream {
 public:
  TokenStream(const std::vector<Token>& tokens, RuleParser::token_kind_type start);

  [[nodiscard]] Token next();
  /// The token handed out last is wrong (or the place after it): skip to the end of the statement
  /// or item that it stands in.
  void resynchronize();
  /// The next resynchronization skips everything that is left.
  void stop() { stopped_ = true; }

  /// The token handed out last, and the one before it in the text.
  [[nodiscard]] const Token& last() const { return last_; }
  [[nodiscard]] const Token* before_last() const;
  /// Was the last token made up by the stream?
  [[nodiscard]] bool last_is_virtual() const { return last_is_virtual_; }
  /// The `{` that are not closed yet.
  [[nodiscard]] const std::vector<Token>& open_blocks() const { return open_; }

 private:
  [[nodiscard]] bool begins_item(std::size_t i) const;
  [[nodiscard]] bool begins_statement(std::size_t i, bool is_wrong) const;
  [[nodiscard]] std::size_t end_of_damage(std::size_t from) const;
  [[nodiscard]] std::size_t end() const { return tokens_.size() - 1; }
  void take_back_last();

  const std::vector<Token>& tokens_;
  std::vector<Token> pending_;  ///< virtual tokens to hand out first, in reverse order
  std::size_t position_ = 0;    ///< of the next token of the text
  Token last_;
  bool last_is_virtual_ = true;
  bool stopped_ = false;
  std::vector<Token> open_;
  std::optional<Token> closed_;              ///< the `{` that the last token closed
  std::optional<std::size_t> last_resumed_;  ///< where parsing went on after the last error
};

}  // namespace gmsim::syntax
