// SPDX-License-Identifier: MIT
#include "syntax/parse.h"

#include <fmt/format.h>

#include "syntax/parse_context.h"

namespace gmsim::syntax {
namespace {

using token = RuleParser::token;

/// Flex counts in int, and nobody writes rules of this size.
constexpr std::size_t kLargestText = std::size_t{64} << 20;

bool is_small_enough(const support::SourceMap& sources, support::FileId file,
                     support::Diagnostics& diagnostics) {
  if (sources.text(file).size() <= kLargestText) return true;
  diagnostics.report({.kind = support::DiagnosticKind::FileError,
                      .message = fmt::format("`{}` is larger than 64 MiB", sources.name(file))});
  return false;
}

/// Runs the parser; nothing is read from a text that is too large.
template <class Take>
auto parse(const support::SourceMap& sources, support::FileId file,
           support::Diagnostics& diagnostics, RuleParser::token_kind_type start, Take take)
    -> decltype(take(std::declval<ParseContext&>())) {
  if (!is_small_enough(sources, file, diagnostics)) return {};
  ParseContext context(sources, file, diagnostics, start);
  RuleParser(context).parse();
  return take(context);
}

}  // namespace

RuleFile parse_rule_file(const support::SourceMap& sources, support::FileId file,
                         support::Diagnostics& diagnostics) {
  auto items = parse(sources, file, diagnostics, token::READ_FILE,
                     [](ParseContext& context) { return context.take_items(); });
  return {file, std::move(items)};
}

ExprPtr parse_expression(const support::SourceMap& sources, support::FileId file,
                         support::Diagnostics& diagnostics) {
  return parse(sources, file, diagnostics, token::READ_EXPRESSION, [](ParseContext& context) {
    return context.failed() ? nullptr : context.take_expression();
  });
}

std::optional<UnitExpr> parse_unit(const support::SourceMap& sources, support::FileId file,
                                   support::Diagnostics& diagnostics) {
  return parse(sources, file, diagnostics, token::READ_UNIT, [](ParseContext& context) {
    return context.failed() ? std::nullopt : context.take_unit();
  });
}

}  // namespace gmsim::syntax
