// SPDX-License-Identifier: MIT
#include "fuzz/parse_checks.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/parse.h"

namespace gmsim::fuzz {
namespace {

void demand(bool holds, const char* what, const std::string& text) {
  if (holds) return;
  std::fprintf(stderr, "%s:\n%s\n", what, text.c_str());
  std::abort();
}

void check_messages(const support::Diagnostics& diagnostics, const support::SourceMap& sources,
                    const std::string& text) {
  for (const auto& diagnostic : diagnostics.all()) {
    demand(diagnostic.place.has_value(), "a message without a place", text);
    demand(diagnostic.place->begin <= diagnostic.place->end && diagnostic.place->end <= text.size(),
           "a place outside of the text", text);
  }
  std::ostringstream out;
  render(diagnostics, sources, out);
}

void check_file(support::SourceMap& sources, support::FileId id, const std::string& text) {
  support::Diagnostics diagnostics;
  const auto file = syntax::parse_rule_file(sources, id, diagnostics);
  check_messages(diagnostics, sources, text);
  for (const auto& item : file.items)
    demand(item.span.begin < item.span.end && item.span.end <= text.size(), "an item misplaced",
           text);

  // What is left of a file with errors is whole, too.
  support::Diagnostics again;
  const auto reprinted = sources.add("reprinted", syntax::reprint(file));
  const auto same = syntax::parse_rule_file(sources, reprinted, again);
  demand(!again.has_errors(), "reprinted text is refused", text);
  demand(syntax::same_tree(file, same), "reprinted text has another tree", text);
}

void check_expression(support::SourceMap& sources, support::FileId id, const std::string& text) {
  support::Diagnostics diagnostics;
  const auto expr = syntax::parse_expression(sources, id, diagnostics);
  check_messages(diagnostics, sources, text);
  demand(diagnostics.has_errors() == (expr == nullptr), "neither expression nor error", text);
  if (!expr) return;
  support::Diagnostics again;
  const auto reprinted = sources.add("reprinted", syntax::reprint(*expr));
  const auto same = syntax::parse_expression(sources, reprinted, again);
  demand(same && syntax::reprint(*same) == syntax::reprint(*expr), "expression changed", text);
}

void check_unit(support::SourceMap& sources, support::FileId id, const std::string& text) {
  support::Diagnostics diagnostics;
  const auto unit = syntax::parse_unit(sources, id, diagnostics);
  check_messages(diagnostics, sources, text);
  demand(diagnostics.has_errors() != unit.has_value(), "neither unit nor error", text);
}

}  // namespace

void check_parsing(const std::string& text) {
  support::SourceMap sources;
  const auto id = sources.add("input", text);
  check_file(sources, id, text);
  check_expression(sources, id, text);
  check_unit(sources, id, text);
  std::ostringstream out;
  syntax::dump_tokens(sources, id, out);
}

}  // namespace gmsim::fuzz
