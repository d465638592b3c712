// SPDX-License-Identifier: MIT
#include "check_text.h"

#include <sstream>

namespace gmsim::check_tests {

const std::string& particles() {
  static const std::string text = R"(
embedding position    : vec3 [m]   on vertex merge mean;
embedding velocity    : vec3 [m/s] on vertex merge mean = (0, 0, 0);
embedding corner_mass : real [kg]  on corner extensive = 0;
derived   mass        : real [kg]  on vertex(v) = sum(c in vertex(v) / corner : c.corner_mass);
)";
  return text;
}

CheckedText check_text(const std::string& text, bool with_particles) {
  CheckedText checked;
  std::vector<support::FileId> texts;
  if (with_particles) texts.push_back(checked.sources.add("particles.rule", particles()));
  checked.file = checked.sources.add("my.rule", text);
  texts.push_back(checked.file);
  check::LibraryOptions options;
  options.with_stdlib = false;
  checked.rules = check::check_texts(texts, options, checked.sources, checked.diagnostics);
  return checked;
}

std::string CheckedText::messages() const {
  std::ostringstream out;
  support::render(diagnostics, sources, out);
  return out.str();
}

std::string CheckedText::dump(int dimension) const {
  std::ostringstream out;
  check::dump_checked(rules.in(dimension), file, out);
  std::istringstream in(out.str());
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    const bool footprint = line.starts_with("  reads ") || line.starts_with("  writes ");
    if (!footprint) kept += line + "\n";
  }
  return kept;
}

std::vector<std::string> CheckedText::errors() const {
  std::vector<std::string> list;
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    list.push_back(std::string(support::name_of(diagnostic.kind)) + "|" +
                   (diagnostic.place ? std::string(sources.text(*diagnostic.place)) : ""));
  return list;
}

std::string checked_expression(const CheckedText& rules, int dimension, const std::string& text) {
  support::SourceMap sources = rules.sources;
  support::Diagnostics diagnostics;
  const check::CheckedExpression checked =
      check::check_expression(rules.rules, dimension, sources.add("expression", text),
                              types::ValueType{}, sources, diagnostics);
  if (!checked.value) {
    std::string messages = "error:";
    for (const support::Diagnostic& diagnostic : diagnostics.all())
      messages += " " + diagnostic.message;
    return messages;
  }
  types::ExprNames names;
  names.slots = checked.slot_names;
  const check::RuleLibrary& library = rules.rules.in(dimension);
  for (const gmap::EmbeddingDecl& value : library.schema) names.embeddings.push_back(value.name);
  for (const check::Interaction& law : library.interactions)
    names.interactions.push_back(law.name);
  const std::string unit = checked.value->unit ? " [" + to_string(*checked.value->unit) + "]" : "";
  return to_string(*checked.value, names) + " : " + to_string(checked.value->type) + unit;
}

}  // namespace gmsim::check_tests
