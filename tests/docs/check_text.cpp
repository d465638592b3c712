// SPDX-License-Identifier: MIT
#include "docs/check_text.h"

#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "check/check.h"

namespace gmsim::test {
namespace {

CheckOutcome outcome_of(const support::Diagnostics& diagnostics,
                        const support::SourceMap& sources) {
  CheckOutcome outcome;
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    if (diagnostic.severity == support::Severity::Error)
      outcome.error_kinds.insert(std::string(support::name_of(diagnostic.kind)));
  std::ostringstream out;
  support::render(diagnostics, sources, out);
  outcome.rendered = out.str();
  return outcome;
}

}  // namespace

CheckOutcome check_rule_texts(const std::vector<NamedText>& texts, bool with_stdlib) {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  std::vector<support::FileId> files;
  for (const NamedText& text : texts) files.push_back(sources.add(text.name, text.text));
  check::LibraryOptions options;
  options.with_stdlib = with_stdlib;
  static_cast<void>(check::check_texts(files, options, sources, diagnostics));
  return outcome_of(diagnostics, sources);
}

CheckOutcome check_scene_expression(const NamedText& text, int dimension) {
  static support::SourceMap sources;
  static support::Diagnostics of_library;
  static const check::CheckedRules library = check::check_texts({}, {}, sources, of_library);
  support::Diagnostics diagnostics;
  const auto file = sources.add(text.name, text.text);
  static_cast<void>(check::check_expression(library, dimension, file, {}, sources, diagnostics));
  return outcome_of(diagnostics, sources);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace gmsim::test
