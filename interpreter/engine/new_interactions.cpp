// SPDX-License-Identifier: MIT
#include "engine/new_interactions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "engine/enumerate.h"
#include "engine/evaluate_at.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using support::DiagnosticKind;

NewInteractions::NewInteractions(State& state, const Model& model)
    : state_(state), model_(model), matcher_(state) {}

NewInteractions::Diagnostic NewInteractions::carry(Rewriter& rewriter, EmbeddingId presence,
                                                   DartId smallest) {
  const compile::Program& program = state_.program;
  const auto active =
      std::ranges::find_if(model_.interactions, [&](const ActiveInteraction& candidate) {
        return program.interaction_bodies[candidate.interaction].presence == presence;
      });
  if (active == model_.interactions.end()) return std::nullopt;
  const compile::RootedPattern& pattern = program.interactions[active->interaction];
  const std::vector<DartId> orbit = gmap::orbit_darts(state_.map, pattern.orbit, smallest);
  Diagnostic error;
  for (const InteractionSite& site : active->sites) {
    const bool asked = asks_for(site, pattern, orbit, error);
    DartId start = gmap::kNoDart;
    if (asked && start_match(pattern, orbit, start, error))
      return give(rewriter, *active, site, start);
    if (error) return error;
  }
  return std::nullopt;
}

bool NewInteractions::asks_for(const InteractionSite& site, const compile::RootedPattern& pattern,
                               std::span<const DartId> orbit, Diagnostic& error) {
  if (site.body && body_of(orbit.front()) != site.body) return false;
  return std::ranges::any_of(orbit, [&](DartId dart) {
    if (error || !matches(pattern, dart, error)) return false;
    return !site.where || holds_at(matcher_.evaluator(), *site.where, dart, error);
  });
}

bool NewInteractions::start_match(const compile::RootedPattern& pattern,
                                  std::span<const DartId> orbit, DartId& start,
                                  Diagnostic& error) {
  for (const DartId dart : orbit) {
    frame_.reset(pattern.frame_size);
    const Start found = start_at(matcher_, pattern.match, pattern.first.get(), pattern.first_dart,
                                 dart, frame_, match_, error);
    if (error) return false;
    if (found != Start::Yes) continue;
    start = dart;
    return true;
  }
  error = support::Diagnostic{
      DiagnosticKind::NoMatch,
      fmt::format("no dart of the new {} orbit of dart {} meets the condition of `first`",
                  types::to_string(pattern.orbit), types::index(orbit.front())),
      pattern.first ? pattern.first->span : pattern.name_span};
  return false;
}

bool NewInteractions::matches(const compile::RootedPattern& pattern, DartId dart,
                              Diagnostic& error) {
  frame_.reset(pattern.frame_size);
  return start_at(matcher_, pattern.match, nullptr, {}, dart, frame_, match_, error) == Start::Yes;
}

NewInteractions::Diagnostic NewInteractions::give(Rewriter& rewriter,
                                                  const ActiveInteraction& active,
                                                  const InteractionSite& site, DartId start) {
  const compile::InteractionBody& body = state_.program.interaction_bodies[active.interaction];
  const double yes = 1;
  rewriter.set_value(body.presence, start, {&yes, 1});
  for (std::size_t i = 0; i < active.parameters.size(); ++i) {
    const ParameterBinding& parameter = active.parameters[i];
    if (parameter.kind == ParameterBinding::Kind::OfTime) continue;
    std::vector<double> value = parameter.uniform.data;
    if (parameter.kind == ParameterBinding::Kind::Stored) {
      const std::span<const double> own = state_.store.get(parameter.embedding, start);
      value.assign(own.begin(), own.end());  // the rule's
      if (own.empty()) {
        if (Diagnostic error = evaluate(body, i, site, start, value)) return error;
        rewriter.set_value(parameter.embedding, start, value);
      }
    }
    frame_.set(body.parameters[i].slot, value);  // the defaults below read it
  }
  return std::nullopt;
}

NewInteractions::Diagnostic NewInteractions::evaluate(const compile::InteractionBody& body,
                                                      std::size_t parameter,
                                                      const InteractionSite& site, DartId start,
                                                      std::vector<double>& value) {
  TreeEvaluator& evaluator = matcher_.evaluator();
  const compile::BodyParameter& about = body.parameters[parameter];
  const DartExpression& given = site.given[parameter];
  Diagnostic error;
  if (given.value) {
    if (const auto result = value_at(evaluator, given, start, error)) value = result->data;
  } else {
    value.resize(types::component_count(about.type));
    if (!define_lets(body, *about.default_value, evaluator, frame_) ||
        !evaluator.evaluate(*about.default_value, frame_, value))
      error = evaluator.take_failure().diagnostic;
  }
  if (!error && !std::ranges::all_of(value, [](double x) { return std::isfinite(x); }))
    error = support::Diagnostic{DiagnosticKind::NonFinite,
                                fmt::format("the parameter `{}` is not finite", about.name),
                                given.value ? given.value->span : about.default_value->span};
  if (error)
    error->notes.push_back(fmt::format("parameter `{}` of `{}` at the new orbit of dart {}",
                                       about.name, body.name, types::index(start)));
  return error;
}

/// Walks from what rules made to what was there before.
std::optional<std::uint32_t> NewInteractions::body_of(DartId dart) const {
  std::vector<DartId> reached{dart};
  std::unordered_set<std::uint32_t> seen;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const std::size_t number = types::index(reached[k]);
    if (number < model_.body_of_dart.size()) return model_.body_of_dart[number];
    for (int i = 0; i <= state_.map.dimension(); ++i) {
      const DartId next = state_.map.alpha(i, reached[k]);
      if (seen.insert(types::index(next)).second) reached.push_back(next);
    }
  }
  return std::nullopt;
}

bool define_lets(const compile::ItemBody& body, const types::Expr& expr, TreeEvaluator& evaluator,
                 Frame& frame) {
  if (expr.kind == types::ExprKind::Local && !frame.has(expr.slot)) {
    const auto let = std::ranges::find_if(body.steps, [&](const compile::BodyStep& step) {
      return step.kind == compile::BodyStep::Kind::Let && step.slot == expr.slot;
    });
    if (let == body.steps.end()) return true;  // bound inside the expression
    return define_lets(body, *let->value, evaluator, frame) &&
           evaluator.assign(*let->value, let->slot, frame);
  }
  return std::ranges::all_of(expr.args, [&](const types::ExprPtr& part) {
    return define_lets(body, *part, evaluator, frame);
  });
}

}  // namespace gmsim::engine
