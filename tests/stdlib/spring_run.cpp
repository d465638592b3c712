// SPDX-License-Identifier: MIT
#include "stdlib/spring_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "compile/compile.h"
#include "engine/enumerate.h"
#include "gmap/orbit_walk.h"

namespace gmsim::test {
namespace {

using types::DartId;
using types::ExprKind;

const check::Interaction& interaction_named(BlockState& block, const std::string& name) {
  const check::Interaction* item = block.library().find_interaction(name);
  if (!item) throw std::runtime_error("no interaction named `" + name + "`");
  return *item;
}

types::OrbitType vertex_orbit(const BlockState& block) {
  return types::OrbitType::cell(0, block.program().dimension);
}

}  // namespace

SpringRun::SpringRun(BlockState& block, const std::string& interaction,
                     const YAML::Node& parameters, const YAML::Node& where)
    : block_(block),
      item_(interaction_named(block, interaction)),
      plan_(compile::compile_pattern(item_.match, {item_.hook})),
      matcher_(block.state()) {
  find_matches(parameters, where);
}

void SpringRun::find_matches(const YAML::Node& parameters, const YAML::Node& where) {
  std::optional<check::CheckedExpression> condition;
  if (where) condition = block_.expression(where.as<std::string>(), {types::ValueKind::Bool});
  engine::Enumeration enumeration{.orbit = item_.orbit, .first = item_.first.get(),
                                  .first_dart = item_.first_dart};
  if (condition)
    enumeration.where = [&](DartId dart) { return block_.holds(*condition, dart); };
  const auto error = engine::for_each_match(
      matcher_, block_.state(), plan_, item_.frame_size, {}, enumeration,
      [&](DartId dart, const engine::Match&, engine::Frame&) {
        matches_.push_back({dart, {}});
      });
  if (error) throw std::runtime_error(error->message);
  for (Found& found : matches_) found.parameters = parameters_at(found.dart, parameters);
  store_parameters();
}

/// Criteria read the parameters where the engine keeps them.
void SpringRun::store_parameters() {
  engine::State& state = block_.state();
  for (std::size_t i = 0; i < item_.parameters.size(); ++i) {
    const auto id = item_.parameters[i].embedding.value();
    state.use(id);
    for (const Found& found : matches_)
      state.store.set(id, found.dart, found.parameters[i].second.data);
  }
}

engine::Arguments SpringRun::parameters_at(DartId dart, const YAML::Node& given) {
  engine::Arguments values;
  engine::Match match;
  for (const check::Parameter& parameter : item_.parameters) {
    if (given && given[parameter.name]) {
      const auto text = given[parameter.name].as<std::string>();
      types::Value value{.type = parameter.type};
      value.data = block_.value(text, dart, parameter.type);
      values.emplace_back(parameter.slot, std::move(value));
      continue;
    }
    if (!parameter.default_value)
      throw std::runtime_error("no value for parameter `" + parameter.name + "`");
    engine::Frame frame(item_.frame_size);
    for (const auto& [slot, value] : values) frame.set(slot, value);
    if (!matcher_.match(plan_, {&dart, 1}, frame, match)) throw std::runtime_error("no match");
    types::Value value{.type = parameter.type};
    value.data = evaluate(*parameter.default_value, frame);
    values.emplace_back(parameter.slot, std::move(value));
  }
  return values;
}

std::vector<double> SpringRun::evaluate(const types::Expr& expr, engine::Frame& frame) {
  std::vector<double> out(types::component_count(expr.type));
  if (matcher_.evaluator().evaluate(expr, frame, out)) return out;
  throw std::runtime_error(matcher_.evaluator().take_failure().diagnostic.message);
}

bool SpringRun::available(const types::Expr& expr) const {
  if (expr.kind == ExprKind::Grad) return false;
  if (expr.kind == ExprKind::Local && std::ranges::find(skipped_, expr.slot) != skipped_.end())
    return false;
  return std::ranges::all_of(expr.args,
                             [&](const types::ExprPtr& part) { return available(*part); });
}

template <class Visit>
void SpringRun::at_match(const Found& found, std::uint32_t frame_size,
                         const std::vector<check::Step>& steps, Visit&& visit) {
  engine::Frame frame(frame_size);
  engine::Match match;
  for (const auto& [slot, value] : found.parameters) frame.set(slot, value);
  if (!matcher_.match(plan_, {&found.dart, 1}, frame, match)) throw std::runtime_error("no match");
  skipped_.clear();
  for (const check::Step& step : steps) {
    if (step.kind != check::Step::Kind::Let) continue;
    if (!available(*step.value))
      skipped_.push_back(step.slot);
    else if (!matcher_.evaluator().assign(*step.value, step.slot, frame))
      throw std::runtime_error(matcher_.evaluator().take_failure().diagnostic.message);
  }
  visit(frame);
}

double SpringRun::energy() {
  if (!item_.energy) return 0;
  double total = 0;
  for (const Found& found : matches_)
    at_match(found, item_.frame_size, item_.steps,
             [&](engine::Frame& frame) { total += evaluate(*item_.energy, frame)[0]; });
  return total;
}

std::array<double, 3> SpringRun::force(DartId vertex) {
  const auto position = *block_.library().schema.find("position");
  engine::State& state = block_.state();
  const auto here = state.store.get(position, vertex);
  const std::array<double, 3> at = {here[0], here[1], here[2]};
  std::array<double, 3> force{};
  constexpr double kStep = 1e-5;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto energy_at = [&](double offset) {
      std::array<double, 3> moved = at;
      moved[k] += offset;
      state.store.set(position, vertex, moved);
      const double value = energy();
      state.store.set(position, vertex, at);
      return value;
    };
    force[k] = -(energy_at(kStep) - energy_at(-kStep)) / (2 * kStep);
  }
  for (const Found& found : matches_) add_explicit(found, vertex, force);
  return force;
}

void SpringRun::add_explicit(const Found& found, DartId vertex, std::array<double, 3>& force) {
  const auto on_vertex = [&](DartId dart) {
    return gmap::same_orbit(block_.state().map, vertex_orbit(block_), dart, vertex);
  };
  const auto add = [&](const check::ForceLine& line, engine::Frame& frame) {
    const auto value = evaluate(*line.value, frame);
    for (std::size_t k = 0; k < 3; ++k) force[k] += value[k];
  };
  at_match(found, item_.frame_size, item_.steps, [&](engine::Frame& frame) {
    for (const check::ForceLine& line : item_.forces) {
      if (!line.value || !available(*line.value)) continue;
      if (line.collection) {
        std::vector<DartId> darts;
        if (!matcher_.evaluator().evaluate_darts(*line.collection, frame, darts))
          throw std::runtime_error(matcher_.evaluator().take_failure().diagnostic.message);
        for (const DartId dart : darts) {
          frame.set(line.variable, dart);
          if (on_vertex(dart)) add(line, frame);
        }
        continue;
      }
      for (const types::ExprPtr& target : line.targets) {
        DartId dart{};
        if (!matcher_.evaluator().evaluate_dart(*target, frame, dart))
          throw std::runtime_error(matcher_.evaluator().take_failure().diagnostic.message);
        if (on_vertex(dart)) add(line, frame);
      }
    }
  });
}

std::vector<double> SpringRun::criterion(const std::string& name) {
  const check::Criterion* criterion = block_.library().find_criterion(name);
  if (!criterion || criterion->interaction != item_.id)
    throw std::runtime_error(fmt::format("no criterion `{}` of `{}`", name, item_.name));
  std::vector<double> values;
  for (const Found& found : matches_)
    at_match(found, criterion->frame_size, criterion->steps, [&](engine::Frame& frame) {
      values.push_back(evaluate(*criterion->value, frame)[0]);
    });
  return values;
}

}  // namespace gmsim::test
