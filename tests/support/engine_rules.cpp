// SPDX-License-Identifier: MIT
#include "support/engine_rules.h"

#include <bit>
#include <cstdint>
#include <random>
#include <sstream>
#include <stdexcept>

#include "check/check.h"
#include "compile/compile.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::tests {

struct RuleBook::Parts {
  support::SourceMap sources;
  check::CheckedRules rules;
  compile::Program program;

  static void demand(const support::Diagnostics& diagnostics, const support::SourceMap& sources) {
    if (!diagnostics.has_errors()) return;
    std::ostringstream text;
    render(diagnostics, sources, text);
    throw std::runtime_error(text.str());
  }
};

RuleBook::RuleBook(const std::string& text, int dimension, bool with_library)
    : parts_(std::make_unique<Parts>()) {
  support::Diagnostics diagnostics;
  check::LibraryOptions options;
  options.with_stdlib = with_library;
  const std::string head = with_library ? "" : "dimension " + std::to_string(dimension) + ";\n";
  const support::FileId file = parts_->sources.add("test.rule", head + text);
  parts_->rules = check::check_texts({file}, options, parts_->sources, diagnostics);
  Parts::demand(diagnostics, parts_->sources);
  parts_->program = compile::compile_program(parts_->rules.in(dimension));
}
RuleBook::~RuleBook() = default;

const compile::Program& RuleBook::program() const { return parts_->program; }

const compile::Rule& RuleBook::rule(std::string_view name) const {
  const compile::Rule* rule = parts_->program.find_rule(name);
  if (rule == nullptr) throw std::runtime_error("no rule " + std::string(name));
  return *rule;
}

const compile::Operation& RuleBook::operation(std::string_view name) const {
  const compile::Operation* operation = parts_->program.find_operation(name);
  if (operation == nullptr) throw std::runtime_error("no operation " + std::string(name));
  return *operation;
}

types::EmbeddingId RuleBook::embedding(std::string_view name) const {
  const auto id = parts_->program.schema.find(name);
  if (!id) throw std::runtime_error("no embedding " + std::string(name));
  return *id;
}

RuleBook::Expression RuleBook::expression(const std::string& text) const {
  support::Diagnostics diagnostics;
  const support::FileId file = parts_->sources.add("expression", text);
  const check::CheckedExpression checked = check::check_expression(
      parts_->rules, parts_->program.dimension, file, {}, parts_->sources, diagnostics);
  Parts::demand(diagnostics, parts_->sources);
  return {checked.value, checked.dart, checked.frame_size};
}

std::string RuleBook::rendered(const support::Diagnostic& diagnostic) const {
  support::Diagnostics diagnostics;
  diagnostics.report(diagnostic);
  std::ostringstream text;
  render(diagnostics, parts_->sources, text);
  return text.str();
}

std::unique_ptr<engine::State> make_state(const compile::Program& program, gmap::GMap map,
                                          std::uint64_t seed) {
  auto state = std::make_unique<engine::State>(program, std::move(map));
  state->use_data();
  fill_random(*state, seed);
  return state;
}

std::unique_ptr<engine::State> make_state(const compile::Program& program, const gmap::Mesh& mesh,
                                          std::uint64_t seed) {
  gmap::MeshMap built = gmap::build_map(mesh);
  auto state = make_state(program, std::move(built.map), seed);
  const auto position = program.schema.find("position");
  if (!position) return state;
  for (std::uint32_t d = 0; d < built.dart_point.size(); ++d) {
    state->store.set(*position, types::DartId{d}, mesh.points[built.dart_point[d]]);
  }
  return state;
}

void fill_random(engine::State& state, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (const types::EmbeddingId id : state.store.embeddings()) {
    const gmap::EmbeddingDecl& decl = state.program.schema[id];
    if (decl.optional) continue;
    const gmap::OrbitIndex& index = state.store.index_of(id);
    gmap::EmbeddingColumn& column = state.store.column(id);
    std::vector<double> value(column.stride());
    for (gmap::Row row = 0; row < index.row_end(); ++row) {
      if (!index.alive(row)) continue;
      for (double& x : value) {
        const bool whole = decl.type.kind <= types::ValueKind::Int;
        x = whole ? static_cast<double>(random() % 2)
                  : static_cast<double>(random() >> 11) * 0x1p-53;
      }
      column.set(row, value);
    }
  }
}

types::Value evaluate(const engine::State& state, const RuleBook::Expression& expr,
                      types::DartId dart) {
  engine::TreeEvaluator evaluator(state);
  engine::Frame frame(expr.frame_size);
  frame.set(expr.dart, dart);
  std::optional<types::Value> value = evaluator.evaluate(*expr.value, frame);
  if (!value) throw std::runtime_error(evaluator.take_failure().diagnostic.message);
  return *value;
}

std::string fingerprint(const engine::State& state) {
  std::ostringstream text;
  text << state.map.dart_end() << ' ' << state.map.dart_count() << '\n';
  for (int i = 0; i <= state.map.dimension(); ++i) {
    for (const types::DartId d : state.map.alphas(i)) text << types::index(d) << ' ';
  }
  for (const auto& index : state.store.indices()) {
    text << '\n' << types::to_string(index->type()) << ' ' << index->orbit_count() << ": ";
    for (const gmap::Row row : index->rows()) text << row << ' ';
    for (gmap::Row row = 0; row < index->row_end(); ++row) {
      text << types::index(index->smallest(row)) << ' ';
    }
  }
  for (const types::EmbeddingId id : state.store.embeddings()) {
    const gmap::EmbeddingColumn& column = state.store.column(id);
    text << '\n' << types::index(id) << ": ";
    for (gmap::Row row = 0; row < column.row_end(); ++row) text << column.has(row);
    for (const double x : column.data()) text << ' ' << std::hex << std::bit_cast<std::uint64_t>(x);
    text << std::dec;
  }
  return text.str();
}

}  // namespace gmsim::tests
