// SPDX-License-Identifier: MIT
#include "stdlib/block_state.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "compile/compile.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "scene/mesh_state.h"
#include "stdlib/block_mesh.h"

namespace gmsim::test {
namespace {

/// The library is checked once for all blocks that bring no rules of their own.
std::shared_ptr<check::CheckedRules> library_alone() {
  static support::SourceMap sources;
  static const std::shared_ptr<check::CheckedRules> rules = [] {
    support::Diagnostics diagnostics;
    auto checked = std::make_shared<check::CheckedRules>(
        check::check_texts({}, {}, sources, diagnostics));
    if (diagnostics.has_errors()) {
      std::ostringstream out;
      support::render(diagnostics, sources, out);
      throw std::runtime_error("the library has errors\n" + out.str());
    }
    return checked;
  }();
  return rules;
}

}  // namespace

BlockState::BlockState(const TestBlock& block) {
  check_rules(block);
  build(block);
}

std::string BlockState::rendered() const {
  std::ostringstream out;
  support::render(diagnostics_, sources_, out);
  return out.str();
}

void BlockState::check_rules(const TestBlock& block) {
  if (!block.yaml["rules"]) {
    rules_ = library_alone();
    return;
  }
  const auto text = sources_.add(fmt::format("{}:{}", block.file.filename().string(), block.line),
                                 block.yaml["rules"].as<std::string>());
  rules_ = std::make_shared<const check::CheckedRules>(
      check::check_texts({text}, {}, sources_, diagnostics_));
  if (diagnostics_.has_errors()) throw std::runtime_error(rendered());
}

void BlockState::build(const TestBlock& block) {
  const gmap::Mesh mesh = mesh_of(block.yaml["mesh"], diagnostics_);
  mesh_map_ = gmap::build_map(mesh);
  if (mesh_map_.failed())
    throw std::runtime_error("bad mesh: " + mesh_map_.problems.front().message);
  program_ = compile::compile_program(rules_->in(mesh.dimension));
  state_ = std::make_unique<engine::State>(program_, mesh_map_.map);
  state_->use_data();
  const YAML::Node density = block.yaml["density"];
  scene::set_positions(*state_, mesh, mesh_map_.dart_point);
  scene::set_corner_masses(*state_, mesh, mesh_map_.dart_cell,
                           density ? density.as<double>() : 1.0);
}

check::CheckedExpression BlockState::expression(const std::string& text,
                                                const types::ValueType& wanted) {
  const auto file = sources_.add(text, text);
  check::CheckedExpression checked = check::check_expression(*rules_, program_.dimension, file,
                                                             wanted, sources_, diagnostics_);
  if (!checked.value || diagnostics_.has_errors()) throw std::runtime_error(rendered());
  return checked;
}

std::vector<double> BlockState::value(const check::CheckedExpression& expression, DartId dart) {
  engine::TreeEvaluator evaluator(*state_);
  engine::Frame frame(expression.frame_size);
  frame.set(expression.dart, dart);
  if (const auto value = evaluator.evaluate(*expression.value, frame)) return value->data;
  support::Diagnostics failed;
  failed.report(evaluator.take_failure().diagnostic);
  std::ostringstream out;
  support::render(failed, sources_, out);
  throw std::runtime_error(out.str());
}

std::vector<double> BlockState::value(const std::string& text, DartId dart,
                                      const types::ValueType& wanted) {
  return value(expression(text, wanted), dart);
}

bool BlockState::holds(const check::CheckedExpression& condition, DartId dart) {
  return value(condition, dart).at(0) != 0;
}

types::OrbitType BlockState::orbit(const std::string& text) {
  if (const auto named = library().find_orbit(text)) return *named;
  if (!text.starts_with('<')) throw std::runtime_error("no orbit named `" + text + "`");
  types::OrbitType type;
  for (const char c : text)
    if (c >= '0' && c <= '9') type.insert(c - '0');
  return type;
}

void BlockState::set(const std::string& embedding, const std::string& text) {
  const auto id = library().schema.find(embedding);
  if (!id) throw std::runtime_error("no embedding named `" + embedding + "`");
  const check::CheckedExpression expr = expression(text, library().schema[*id].type);
  std::vector<std::pair<DartId, std::vector<double>>> values;
  for (const DartId dart : gmap::all_orbits(state_->map, library().schema[*id].orbit))
    values.emplace_back(dart, value(expr, dart));
  for (const auto& [dart, numbers] : values) state_->store.set(*id, dart, numbers);
}

std::string BlockState::invalid() const {
  const auto problems = gmap::validate(state_->map, state_->store);
  return fmt::format("{}", fmt::join(problems, "; "));
}

}  // namespace gmsim::test
