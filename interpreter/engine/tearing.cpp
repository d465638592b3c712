// SPDX-License-Identifier: MIT
#include "engine/tearing.h"

#include <algorithm>
#include <utility>

#include "engine/apply_change.h"
#include "engine/evaluate_at.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

Tearing::Tearing(Rewriter& rewriter, std::span<const TearPairing> pairings)
    : rewriter_(rewriter),
      evaluator_(rewriter.state()),
      pairings_(pairings) {}

void Tearing::apply(std::span<const TearRequest> requests, TearOutcome& outcome) {
  for (const TearRequest& request : requests) {
    apply_one(request, outcome);
    if (outcome.error) return;
  }
}

void Tearing::apply_one(const TearRequest& request, TearOutcome& outcome) {
  std::vector<DartId> parts;
  find_parts(request, parts);
  if (parts.empty()) ++outcome.dropped;
  for (const DartId hook : parts) {
    const State& state = rewriter_.state();
    // An earlier part may have taken this one with it.
    if (!state.map.alive(hook)) continue;
    const compile::RootedPattern& pattern =
        state.program.criteria[pairings_[request.pairing].criterion];
    if (!matches(pattern, hook)) {
      ++outcome.dropped;
      continue;
    }
    run(request, match_.dart(0, static_cast<compile::Column>(request.node)), outcome);
    if (outcome.error) return;
  }
}

void Tearing::find_parts(const TearRequest& request, std::vector<DartId>& parts) {
  const State& state = rewriter_.state();
  const compile::RootedPattern& pattern =
      state.program.criteria[pairings_[request.pairing].criterion];
  std::vector<DartId> left = request.orbit;
  std::erase_if(left, [&](DartId d) { return !state.map.alive(d); });
  std::vector<DartId> part;
  while (!left.empty()) {
    part.clear();
    gmap::for_each_dart(state.map, pattern.orbit, left.front(),
                        [&](DartId d) { part.push_back(d); });
    std::sort(part.begin(), part.end());
    std::erase_if(left, [&](DartId d) { return std::binary_search(part.begin(), part.end(), d); });
    // The dart that was judged speaks for its part; the others by their first dart that matches.
    const bool judged = std::binary_search(part.begin(), part.end(), request.hook);
    if (judged && matches(pattern, request.hook)) {
      parts.push_back(request.hook);
      continue;
    }
    const auto first =
        std::find_if(part.begin(), part.end(), [&](DartId d) { return matches(pattern, d); });
    if (first != part.end()) parts.push_back(*first);
  }
}

bool Tearing::matches(const compile::RootedPattern& pattern, DartId hook) {
  frame_.reset(pattern.frame_size);
  return rewriter_.matcher().match(pattern.match, {&hook, 1}, frame_, match_);
}

Tearing::Failure Tearing::gather_arguments(const TearRequest& request, DartId dart,
                                           Arguments& arguments) {
  const TearPairing& pairing = pairings_[request.pairing];
  const auto& results = rewriter_.state().program.criterion_bodies[pairing.criterion].results;
  for (const TearPairing::Argument& argument : pairing.arguments) {
    types::Value value;
    if (argument.result) {
      std::size_t begin = 0;
      for (std::uint32_t k = 0; k < *argument.result; ++k)
        begin += types::component_count(results[k].type);
      value.type = results[*argument.result].type;
      const std::size_t count = types::component_count(value.type);
      value.data.assign(request.results.begin() + static_cast<std::ptrdiff_t>(begin),
                        request.results.begin() + static_cast<std::ptrdiff_t>(begin + count));
    } else {
      Failure error;
      std::optional<types::Value> computed = value_at(evaluator_, argument.value, dart, error);
      if (!computed) return error;
      value = std::move(*computed);
    }
    arguments.emplace_back(argument.slot, std::move(value));
  }
  return std::nullopt;
}

void Tearing::run(const TearRequest& request, DartId dart, TearOutcome& outcome) {
  const State& state = rewriter_.state();
  const TearPairing& pairing = pairings_[request.pairing];
  Arguments arguments;
  outcome.error = gather_arguments(request, dart, arguments);
  if (outcome.error) return;

  TearEvent event{state.step, state.time, request.pairing, request.value, request.threshold, dart};
  const auto position = state.program.schema.find("position");
  if (position) {
    const std::span<const double> value = state.store.get(*position, dart);
    std::copy(value.begin(), value.end(), event.position.begin());
  }
  RewriteOutcome done = apply_change(rewriter_, pairing.change, dart, arguments);
  if (done.status == RewriteOutcome::Status::Failed) outcome.error = std::move(done.error);
  if (!done.applied()) {
    ++outcome.dropped;
    return;
  }
  // An operation may find nothing left to do: nothing happened, which is no event.
  if (done.effects.nothing()) return;
  if (const gmap::OrbitRepair* vertices = done.effects.find(OrbitType::cell(0, state.map.dimension()))) {
    event.split = vertices->split;
    event.created = vertices->created;
    event.removed = static_cast<std::uint32_t>(vertices->removed.size());
  }
  outcome.events.push_back(event);
  outcome.effects.append(done.effects);
}

}  // namespace gmsim::engine
