// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/ast.h"

namespace gmsim::syntax {

/// Parses a rule file. Errors go to `diagnostics`; after an error parsing resumes at the next `;`,
/// `}` or item, so that one run shows several. Items that were read whole are returned even then.
/// Any text gives diagnostics or a tree: nesting, the height of trees and the length of a text are
/// bounded, and reading gives up after 100 errors.
[[nodiscard]] RuleFile parse_rule_file(const support::SourceMap& sources, support::FileId file,
                                       support::Diagnostics& diagnostics);

/// Parses one expression, as scenes and the command line hold them.
[[nodiscard]] ExprPtr parse_expression(const support::SourceMap& sources, support::FileId file,
                                       support::Diagnostics& diagnostics);

/// A unit without brackets, as in the scene value `60 N/m`.
[[nodiscard]] std::optional<UnitExpr> parse_unit(const support::SourceMap& sources,
                                                 support::FileId file,
                                                 support::Diagnostics& diagnostics);

/// `--dump tokens`: one token a line, with its place.
void dump_tokens(const support::SourceMap& sources, support::FileId file, std::ostream& out);

/// `--dump ast`: an indented tree, one node a line.
void dump_ast(const RuleFile& file, std::ostream& out);

/// The same for one expression.
void dump_ast(const Expr& expr, std::ostream& out);

/// Back to source text; parsing it again gives an equal tree.
[[nodiscard]] std::string reprint(const RuleFile& file);
[[nodiscard]] std::string reprint(const Expr& expr);

/// Equal but for spans.
[[nodiscard]] bool same_tree(const RuleFile& a, const RuleFile& b);

}  // namespace gmsim::syntax
