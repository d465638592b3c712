// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/ast_factories.h"
#include "syntax/depth_guard.h"
#include "syntax/scanner.h"
#include "syntax/token_stream.h"

namespace gmsim::syntax {

/// Reading gives up after this many errors in one text.
inline constexpr std::size_t kMostErrors = 100;
/// Brackets, blocks, prefix operators and powers inside of one another.
inline constexpr int kDeepestNesting = 256;
/// Levels of an expression, which a long sum reaches without any nesting.
inline constexpr std::uint16_t kHighestTree = 512;

/// Everything the parser and the factories know about one text while it is read.
class ParseContext {
 public:
  ParseContext(const support::SourceMap& sources, support::FileId file,
               support::Diagnostics& diagnostics, RuleParser::token_kind_type start);

  ParseContext(const ParseContext&) = delete;  // the scanner reports to this one
  ParseContext& operator=(const ParseContext&) = delete;

  // ---- for the parser ----
  [[nodiscard]] RuleParser::symbol_type next_token();
  /// Counts one more level of nesting in `guard`; false, with an error reported, at the limit.
  [[nodiscard]] bool enter(DepthGuard& guard, Span after);
  /// Notes what kind of item is being read, for messages.
  [[nodiscard]] ItemHead begin(ItemKind kind, ItemHead head);
  void accept(Item item);
  void accept(ExprPtr expression) { expression_ = std::move(expression); }
  void accept(UnitExpr unit) { unit_ = std::move(unit); }
  using ExpectedTokens = std::function<std::vector<RuleParser::symbol_kind_type>()>;
  void report_unexpected(const ExpectedTokens& expected);

  [[nodiscard]] Name name(Span place) const { return {std::string(text(place)), place}; }

  // ---- for the factories ----
  [[nodiscard]] std::string_view text(Span place) const {
    return text_.substr(place.begin, place.end - place.begin);
  }
  void report(support::Diagnostic diagnostic);
  /// An expression has become too high. A sum that goes on after that is reported once.
  void report_too_high(Span place);
  [[nodiscard]] std::string doc_above(const Span& item) const;

  // ---- results ----
  [[nodiscard]] bool failed() const { return !error_places_.empty(); }
  [[nodiscard]] std::vector<Item> take_items() { return std::move(items_); }
  [[nodiscard]] ExprPtr take_expression() { return std::move(expression_); }
  [[nodiscard]] std::optional<UnitExpr> take_unit() { return std::move(unit_); }

 private:
  bool count_error(const support::Diagnostic& diagnostic);
  [[nodiscard]] bool has_scan_error(std::uint32_t begin, std::uint32_t end) const;

  std::string_view text_;
  support::FileId file_;
  support::Diagnostics& diagnostics_;
  std::vector<std::uint32_t> error_places_;  ///< those of the scanner, in order, then the parser's
  Scanner scanner_;
  std::size_t scan_error_count_;
  TokenStream stream_;
  int depth_ = 0;
  ItemKind item_kind_ = ItemKind::Rule;
  std::optional<std::uint32_t> too_high_at_;
  std::vector<Item> items_;
  ExprPtr expression_;
  std::optional<UnitExpr> unit_;
};

/// The smallest place around all symbols of a production that have any text; an empty one at the
/// end of what stands before it when none has (the location rule of the grammar).
template <class Symbols>
Span joined_location(const Symbols& symbols, std::ptrdiff_t count) {
  Span joined = symbols[0].location;
  joined.begin = joined.end;
  for (std::ptrdiff_t i = 1; i <= count; ++i) {
    const Span& part = symbols[static_cast<int>(i)].location;
    if (part.empty()) continue;
    if (joined.empty()) joined = part;
    joined.end = part.end;
  }
  return joined;
}

}  // namespace gmsim::syntax
