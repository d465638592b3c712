// SPDX-License-Identifier: MIT
#include "engine/tree_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/force_bound.h"
#include "engine/force_evaluate.h"
#include "engine/force_report.h"
#include "support/check.h"

namespace gmsim::engine {

using Kind = InputOrigin::Kind;
using Entries = IrEvaluator<double>::Entries;

// ---- one interaction ----------------------------------------------------------------------------

TreeInteraction::Programs::Programs(const compile::Shape& shape, const ShapeInputs& inputs)
    : force(force_program(shape, inputs)),
      energy(energy_program(shape, inputs)),
      product(product_program(force.program)),
      direction(direction_program(shape, inputs)) {}

TreeInteraction::TreeInteraction(const ForceContext& context, std::uint32_t number)
    : context_(context), number_(number), finder_(context, number) {}

std::optional<support::Diagnostic> TreeInteraction::rebuild() {
  matches_.clear();
  Diagnostic error = finder_.find_all([&](const ForceMatch& match) { matches_.push_back(match); });
  while (programs_.size() < finder_.shapes().size()) {
    const compile::Shape& shape = finder_.shapes()[programs_.size()];
    const ShapeInputs& inputs = finder_.inputs(static_cast<std::uint32_t>(programs_.size()));
    programs_.push_back(std::make_unique<Programs>(shape, inputs));
  }
  return error;
}

void TreeInteraction::run(Evaluation& evaluation, const ForceMatch& match,
                          const ForceMoment& moment) const {
  evaluate_match(evaluation.program, match, moment, context_.state.store, evaluation.evaluator);
}

// ---- the whole model ----------------------------------------------------------------------------

namespace {

class TreeForces final : public ForceField {
 public:
  TreeForces(const State& state, const Model& model) : context_(state, model.interactions) {
    for (std::uint32_t i = 0; i < context_.active.size(); ++i)
      interactions_.push_back(std::make_unique<TreeInteraction>(context_, i));
  }

  bool evaluate(const Motion& motion, double time, double dt,
                std::span<VertexRecord> force) override;
  bool potential_energy(const Motion& motion, double time, double& energy) override;
  bool product(const Motion& motion, double time, std::span<const VertexRecord> dx,
               std::span<const VertexRecord> dv, std::span<VertexRecord> out) override;
  bool element_bound(const Motion& motion, double time, ElementBound& bound) override;
  std::vector<support::Diagnostic> notices(const Motion& motion, double time) override;
  [[nodiscard]] bool reads_velocity() const override { return reads(Kind::Velocity); }
  [[nodiscard]] bool reads_time() const override {
    return reads(Kind::Time) || reads(Kind::Step) || reads(Kind::Dt);
  }
  void refresh(std::span<const compile::Dependence> changed) override;
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const override { return error_; }
  [[nodiscard]] std::string explain() const override;

 private:
  using Evaluation = TreeInteraction::Evaluation;

  [[nodiscard]] bool reads(Kind kind) const;
  [[nodiscard]] ForceMoment moment(const Motion& motion, double time) const {
    return {.position = motion.position, .velocity = motion.velocity, .time = time,
            .dt = context_.state.dt, .step = step()};
  }
  /// Adds the roots of an evaluation to the vertices of a match. False: not finite.
  bool add_roots(TreeInteraction& of, const ForceMatch& match, Evaluation& evaluation,
                 std::span<VertexRecord> out);
  bool jacobian(TreeInteraction& of, const ForceMatch& match, const Motion& motion, double time,
                bool of_velocity, std::vector<double>& out);

  ForceContext context_;
  std::vector<std::unique_ptr<TreeInteraction>> interactions_;
  std::set<std::pair<std::uint32_t, DartId>> warned_;
  std::vector<VertexRecord> zeros_;
  std::optional<support::Diagnostic> error_;
};

bool TreeForces::add_roots(TreeInteraction& of, const ForceMatch& match, Evaluation& evaluation,
                           std::span<VertexRecord> out) {
  const compile::Shape& shape = of.shape(match);
  for (std::size_t k = 0; k < shape.forces.size(); ++k) {
    const Entries& value = evaluation.evaluator[evaluation.program.roots[k]];
    if (!std::isfinite(value[0]) || !std::isfinite(value[1]) || !std::isfinite(value[2])) {
      error_ = non_finite(of.body(), match, evaluation.program, evaluation.evaluator);
      return false;
    }
    VertexRecord& sum = out[match.roles.roles[shape.forces[k].role].row];
    sum.x += value[0];
    sum.y += value[1];
    sum.z += value[2];
  }
  return true;
}

bool TreeForces::evaluate(const Motion& motion, double time, double dt,
                          std::span<VertexRecord> force) {
  std::fill(force.begin(), force.end(), VertexRecord{});
  if (error_) return false;
  ForceMoment now = moment(motion, time);
  now.dt = dt;
  for (const auto& of : interactions_) {
    for (const ForceMatch& match : of->matches()) {
      Evaluation& evaluation = of->programs(match).force;
      of->run(evaluation, match, now);
      if (!add_roots(*of, match, evaluation, force)) return false;
    }
  }
  return true;
}

bool TreeForces::potential_energy(const Motion& motion, double time, double& energy) {
  energy = 0;
  if (error_) return false;
  for (const auto& of : interactions_) {
    for (const ForceMatch& match : of->matches()) {
      Evaluation& evaluation = of->programs(match).energy;
      if (evaluation.program.roots.empty()) continue;
      of->run(evaluation, match, moment(motion, time));
      const double value = evaluation.evaluator.number(evaluation.program.roots[0]);
      if (!std::isfinite(value)) {
        error_ = non_finite(of->body(), match, evaluation.program, evaluation.evaluator);
        return false;
      }
      energy += value;
    }
  }
  return true;
}

bool TreeForces::product(const Motion& motion, double time, std::span<const VertexRecord> dx,
                         std::span<const VertexRecord> dv, std::span<VertexRecord> out) {
  std::fill(out.begin(), out.end(), VertexRecord{});
  if (error_) return false;
  ForceMoment now = moment(motion, time);
  now.position_change = dx;
  now.velocity_change = dv;
  for (const auto& of : interactions_) {
    for (const ForceMatch& match : of->matches()) {
      Evaluation& evaluation = of->programs(match).product;
      of->run(evaluation, match, now);
      if (!add_roots(*of, match, evaluation, out)) return false;
    }
  }
  return true;
}

/// Minus the derivative of the forces of a match by the positions (velocities) of its vertices.
bool TreeForces::jacobian(TreeInteraction& of, const ForceMatch& match, const Motion& motion,
                          double time, bool of_velocity, std::vector<double>& out) {
  const compile::Shape& shape = of.shape(match);
  Evaluation& evaluation = of.programs(match).product;
  const std::size_t n = 3 * shape.forces.size();
  out.assign(n * n, 0.0);
  zeros_.resize(motion.position.size());
  std::vector<VertexRecord> along(zeros_);
  ForceMoment now = moment(motion, time);
  now.position_change = of_velocity ? zeros_ : along;
  now.velocity_change = of_velocity ? along : zeros_;
  for (std::size_t column = 0; column < n; ++column) {
    VertexRecord& at = along[match.roles.roles[shape.forces[column / 3].role].row];
    (column % 3 == 0 ? at.x : column % 3 == 1 ? at.y : at.z) = 1;
    of.run(evaluation, match, now);
    at = {};
    for (std::size_t row = 0; row < n; ++row) {
      const Entries& value = evaluation.evaluator[evaluation.program.roots[row / 3]];
      out[row * n + column] = -value[row % 3];
      if (std::isfinite(value[row % 3])) continue;
      error_ = non_finite(of.body(), match, evaluation.program, evaluation.evaluator);
      return false;
    }
  }
  return true;
}

bool TreeForces::element_bound(const Motion& motion, double time, ElementBound& bound) {
  if (error_) return false;
  ElementBounds stiffness(context_), damping(context_);
  std::vector<double> matrix;
  for (const auto& of : interactions_) {
    for (const ForceMatch& match : of->matches()) {
      const ElementBounds::Stand stand = stiffness.stand(of->shape(match), match.roles.targets);
      if (!jacobian(*of, match, motion, time, false, matrix)) return false;
      stiffness.add(of->number(), match.key, stand, matrix);
      if (!jacobian(*of, match, motion, time, true, matrix)) return false;
      damping.add(of->number(), match.key, stand, matrix);
    }
  }
  const ElementBounds::Largest largest = stiffness.largest();
  bound = {.stiffness = largest.value,
           .damping = damping.largest().value,
           .where = largest.where,
           .interaction = largest.interaction};
  return true;
}

std::vector<support::Diagnostic> TreeForces::notices(const Motion& motion, double time) {
  std::vector<support::Diagnostic> result;
  for (const auto& of : interactions_) {
    for (const ForceMatch& match : of->matches()) {
      Evaluation& evaluation = of->programs(match).direction;
      if (evaluation.program.roots.empty()) continue;
      of->run(evaluation, match, moment(motion, time));
      if (evaluation.evaluator.number(evaluation.program.roots[0]) == 0) continue;
      if (warned_.emplace(of->number(), match.key).second)
        result.push_back(
            no_direction(of->body(), match, evaluation.program, evaluation.evaluator));
    }
  }
  return result;
}

bool TreeForces::reads(Kind kind) const {
  for (const auto& of : interactions_)
    for (const auto& programs : of->all_programs())
      if (programs->force.program.reads(kind)) return true;
  return false;
}

void TreeForces::refresh(std::span<const compile::Dependence>) {
  error_.reset();
  for (const auto& of : interactions_)
    if ((error_ = of->rebuild())) return;
}

std::string TreeForces::explain() const {
  std::string text = "forces by the tree oracle, one match at a time\n";
  for (const auto& of : interactions_)
    text += fmt::format("  {}: {} matches\n", of->body().name, of->matches().size());
  return text;
}

}  // namespace

std::unique_ptr<ForceField> make_tree_forces(const State& state, const Model& model,
                                             support::Diagnostics& diagnostics) {
  auto forces = std::make_unique<TreeForces>(state, model);
  forces->refresh({});
  if (!forces->error()) return forces;
  diagnostics.report(*forces->error());
  return nullptr;
}

}  // namespace gmsim::engine
