// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <string_view>

#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/parse.h"

namespace gmsim::syntax {

/// A text parsed as a file, with all that was said about it.
struct ParsedFile {
  explicit ParsedFile(std::string text) : id(sources.add("test.rule", std::move(text))) {
    file = parse_rule_file(sources, id, diagnostics);
  }
  [[nodiscard]] std::string messages() const {
    std::ostringstream out;
    render(diagnostics, sources, out, 1000);
    return out.str();
  }
  [[nodiscard]] std::string tree() const {
    std::ostringstream out;
    dump_ast(file, out);
    return out.str();
  }

  support::SourceMap sources;
  support::Diagnostics diagnostics;
  support::FileId id;
  RuleFile file;
};

/// The same for an expression.
struct ParsedExpression {
  explicit ParsedExpression(std::string text) : id(sources.add("test", std::move(text))) {
    expr = parse_expression(sources, id, diagnostics);
  }
  [[nodiscard]] std::string messages() const {
    std::ostringstream out;
    render(diagnostics, sources, out, 1000);
    return out.str();
  }
  [[nodiscard]] std::string tree() const {
    if (!expr) return "no expression\n";
    std::ostringstream out;
    dump_ast(*expr, out);
    return out.str();
  }

  support::SourceMap sources;
  support::Diagnostics diagnostics;
  support::FileId id;
  ExprPtr expr;
};

}  // namespace gmsim::syntax
