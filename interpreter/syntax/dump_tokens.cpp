// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "syntax/parse.h"
#include "syntax/scanner.h"

namespace gmsim::syntax {

void dump_tokens(const support::SourceMap& sources, support::FileId file, std::ostream& out) {
  const std::string_view text = sources.text(file);
  const Scanner scanner(file, text, [](const support::Diagnostic&) { return true; });
  for (const Token& token : scanner.tokens()) {
    const auto at = sources.locate(file, token.begin);
    const char* kind =
        RuleParser::symbol_name(static_cast<RuleParser::symbol_kind_type>(token.kind));
    out << fmt::format("{}:{} {}", at.line, at.column, kind);
    const std::string_view spelled = text.substr(token.begin, token.end - token.begin);
    if (spelled != kind && !spelled.empty()) out << ' ' << spelled;
    out << '\n';
  }
}

}  // namespace gmsim::syntax
