// SPDX-License-Identifier: MIT
#include "engine/criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/evaluate_at.h"
#include "engine/force_context.h"

namespace gmsim::engine {

Criteria::Criteria(State& state, const ForceField& forces, std::span<const TearPairing> pairings)
    : state_(state),
      forces_(forces),
      atomic_(state.map),
      world_(forces.context()->world),
      evaluator_(state) {
  world_.atomic_forces = &atomic_;
  evaluator_.read_forces(&reader_);
  readings_.vertex = types::OrbitType::cell(0, state.map.dimension());
  for (std::uint32_t i = 0; i < pairings.size(); ++i) {
    for (const OrbitType orbit : force_reads(pairings[i], state.program, readings_.vertex).orbits)
      state.store.use_index(orbit);
    fields_.push_back(std::make_unique<CriterionField>(*forces.context(), world_, pairings[i], i));
  }
}

void Criteria::list_forces() {
  listed_.clear();
  forces_.list_atomic(listed_);
  atomic_.rebuild(listed_);
}

void Criteria::add_readings() {
  one_by_one_ = false;
  const std::size_t there = readings_.sums.size();
  for (const auto& field : fields_) {
    field->add_sums(readings_);
    one_by_one_ = one_by_one_ || field->reads_forces_one_by_one();
  }
  for (std::size_t k = there; k < readings_.sums.size(); ++k)
    readings_.sums[k]->rebuild(atomic_, *state_.store.find_index(readings_.sums[k]->orbit()));
}

Criteria::Diagnostic Criteria::rebuild() {
  list_forces();
  readings_.sums.clear();
  for (const auto& field : fields_)
    if (Diagnostic error = field->rebuild()) return error;
  add_readings();
  return std::nullopt;
}

Criteria::Diagnostic Criteria::repair(const Effects& effects, const MapDelta& delta,
                                      std::uint64_t& looked_at) {
  const AtomicForceChanges* changes = forces_.atomic_changes();
  const auto repairable = [](const auto& field) { return field->repairable(); };
  if (changes == nullptr || !std::all_of(fields_.begin(), fields_.end(), repairable)) return rebuild();
  relisted_.clear();
  atomic_.update(*changes, relisted_);
  // Matches that go through single forces depend on the lists of their darts.
  with_lists_ = delta.darts;
  for (const DartId dart : relisted_) with_lists_.push_back({dart, compile::kForceList});
  compile::merge_aspects(with_lists_, &compile::Dependence::dart);
  std::size_t shapes_before = 0, shapes = 0;
  for (const auto& field : fields_) {
    shapes_before += field->shape_count();
    const auto& changed = field->reads_forces_one_by_one() ? with_lists_ : delta.darts;
    if (Diagnostic error = field->repair(changed, looked_at)) return error;
    shapes += field->shape_count();
  }
  update_sums(effects, delta);
  if (shapes > shapes_before) add_readings();
  return std::nullopt;
}

/// Sums on orbits with a changed link, another list of forces, or forces in other slots.
void Criteria::update_sums(const Effects& effects, const MapDelta& delta) {
  const AtomicForceChanges& changes = *forces_.atomic_changes();
  const auto add = [&](DartId dart) {
    if (state_.map.alive(dart)) summed_.push_back(dart);
  };
  for (const auto& sum : readings_.sums) {
    const OrbitType type = sum->orbit();
    summed_.clear();
    for (const auto& [dart, what] : delta.darts)
      if ((what & (compile::links(type) | compile::row_of(type))) != 0) add(dart);
    for (const auto& gone : changes.gone) add(gone.dart);
    for (const AtomicForce& force : changes.come) add(force.dart);
    const gmap::OrbitRepair* repair = effects.find(type);
    sum->update(atomic_, *state_.store.find_index(type), summed_,
                repair == nullptr ? std::span<const Row>{} : std::span<const Row>(repair->removed));
  }
}

void Criteria::read_forces_now() {
  readings_.internal = forces_.internal_sums();
  const std::span<const VertexRecord> slots = forces_.atomic_slots();
  for (const auto& sum : readings_.sums) sum->sum(slots);
  if (one_by_one_) atomic_.read(slots, readings_.atomic);
}

Criteria::Diagnostic Criteria::judge(const Motion& motion, double time, double dt,
                                     const std::function<void()>& sync,
                                     std::vector<TearRequest>& requests) {
  const auto due = [&](const auto& field) { return time >= field->pairing().after; };
  if (std::none_of(fields_.begin(), fields_.end(), due)) return std::nullopt;
  read_forces_now();
  const ForceMoment moment{.position = motion.position, .velocity = motion.velocity, .time = time,
                           .dt = dt, .step = forces_.step(),
                           .forces = &readings_};
  bool synced = false;
  const auto sync_once = [&] {
    if (!std::exchange(synced, true)) sync();
  };
  reader_.slots = forces_.atomic_slots();
  std::vector<TearRequest> of_field;
  for (const auto& field : fields_) {
    if (!due(field)) continue;
    of_field.clear();
    Diagnostic problem;
    const auto allowed_at = [&](DartId hook) {
      sync_once();
      return allowed(field->pairing(), hook, problem);
    };
    if (Diagnostic error = field->judge(moment, allowed_at, of_field)) return error;
    if (problem) return problem;
    if (of_field.empty()) continue;
    sync_once();
    if (Diagnostic error = select(*field, of_field)) return error;
    std::move(of_field.begin(), of_field.end(), std::back_inserter(requests));
  }
  order_requests(requests);
  return std::nullopt;
}

namespace {

/// A threshold that the scene computes may come out wrong where something asks to tear.
std::optional<support::Diagnostic> threshold_problem(const TearPairing& pairing,
                                                     const TearRequest& request,
                                                     const std::string& criterion) {
  if (request.threshold > 0) return std::nullopt;
  support::Diagnostic problem{
      support::DiagnosticKind::OutOfRange,
      fmt::format("a threshold must be above 0, this is {:.6g}", request.threshold), pairing.span};
  for (const SlotValue& parameter : pairing.parameters)
    if (parameter.slot == pairing.threshold) problem.place = parameter.value.value->span;
  problem.notes.push_back(
      fmt::format("of `{}` at dart {}", criterion, types::index(request.hook)));
  problem.help = "leave places that must not tear out with `where`";
  return problem;
}

}  // namespace

bool Criteria::allowed(const TearPairing& pairing, DartId hook, Diagnostic& error) {
  if (!pairing.where) return true;
  return !error && holds_at(evaluator_, *pairing.where, hook, error);
}

Criteria::Diagnostic Criteria::select(const CriterionField& field,
                                      std::vector<TearRequest>& requests) {
  const TearPairing& pairing = field.pairing();
  Diagnostic error;
  std::erase_if(requests, [&](const TearRequest& request) {
    return !allowed(pairing, request.hook, error);
  });
  for (const TearRequest& request : requests)
    if (!error) error = threshold_problem(pairing, request, field.body().name);
  choose_strongest(requests, pairing.at_most);
  if (pairing.at.empty()) return error;
  std::vector<TearRequest> at_nodes;
  for (const TearRequest& request : requests)
    for (const std::uint32_t node : pairing.at) {
      at_nodes.push_back(request);
      at_nodes.back().node = node;
    }
  requests = std::move(at_nodes);
  return error;
}

}  // namespace gmsim::engine
