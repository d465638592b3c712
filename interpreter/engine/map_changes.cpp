// SPDX-License-Identifier: MIT
#include "engine/map_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/apply_change.h"
#include "engine/evaluate_at.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

MapChanges::MapChanges(State& state, const Model& model, const ForceField& forces)
    : state_(state),
      model_(model),
      criteria_(state, forces, model.tears),
      new_interactions_(state, model),
      rewriter_(state),
      tearing_(rewriter_, model.tears),
      evaluator_(state) {
  rewriter_.on_created([this](Rewriter& rewriter, EmbeddingId presence, DartId smallest) {
    return new_interactions_.carry(rewriter, presence, smallest);
  });
  const OrbitType vertex = OrbitType::cell(0, state.map.dimension());
  for (const Hold& hold : model.holds) {
    holds_.emplace_back();
    gmap::for_each_dart(state.map, vertex, hold.vertex,
                        [&](DartId d) { holds_.back().push_back(d); });
  }
}

// ---- rewrites of every step ---------------------------------------------------------------------

MapChanges::Diagnostic MapChanges::rewrite(Effects& effects) {
  for (const StandingRewrite& rewrite : model_.rewrites)
    if (Diagnostic error = run_rewrite(rewrite, effects)) return error;
  release_holds(effects);
  return std::nullopt;
}

MapChanges::Diagnostic MapChanges::run_rewrite(const StandingRewrite& rewrite, Effects& effects) {
  std::vector<DartId> darts;
  Arguments arguments;
  if (Diagnostic error = find_candidates(rewrite, darts)) return error;
  if (Diagnostic error = evaluate_arguments(rewrite, arguments)) return error;
  RewriteOutcome outcome = apply_change(rewriter_, rewrite.change, darts, arguments);
  effects.append(outcome.effects);
  return std::move(outcome.error);
}

MapChanges::Diagnostic MapChanges::find_candidates(const StandingRewrite& rewrite,
                                                   std::vector<DartId>& darts) {
  Diagnostic error;
  for (const DartId dart : gmap::all_orbits(state_.map, rewrite.to)) {
    if (!rewrite.where || holds_at(evaluator_, *rewrite.where, dart, error)) darts.push_back(dart);
    if (error) break;
  }
  return error;
}

MapChanges::Diagnostic MapChanges::evaluate_arguments(const StandingRewrite& rewrite,
                                                      Arguments& arguments) {
  Diagnostic error;
  for (const SlotValue& parameter : rewrite.parameters) {
    std::optional<types::Value> value =
        value_at(evaluator_, parameter.value, gmap::kNoDart, error);
    if (!value) break;
    arguments.emplace_back(parameter.slot, std::move(*value));
  }
  return error;
}

// ---- tearing ------------------------------------------------------------------------------------

bool MapChanges::judges_again() const {
  return std::any_of(model_.tears.begin(), model_.tears.end(),
                     [](const TearPairing& pairing) { return pairing.refresh; });
}

void MapChanges::drop_spent(std::uint32_t pass) {
  if (pass == 0) applied_.assign(model_.tears.size(), 0);
  std::erase_if(requests_, [&](const TearRequest& request) {
    const TearPairing& pairing = model_.tears[request.pairing];
    if (!pairing.refresh) return pass > 0;
    return pairing.at_most && applied_[request.pairing] >= *pairing.at_most;
  });
}

void MapChanges::take_batch() {
  double strongest = 0;  // of the requests that are judged again after each change
  for (const TearRequest& request : requests_)
    if (model_.tears[request.pairing].refresh) strongest = std::max(strongest, request.ratio());
  const auto rest =
      std::stable_partition(requests_.begin(), requests_.end(), [&](const TearRequest& request) {
        return !model_.tears[request.pairing].refresh || request.ratio() >= strongest * (1 - kTie);
      });
  batch_.assign(requests_.begin(), rest);
  requests_.erase(requests_.begin(), rest);
}

MapChanges::Diagnostic MapChanges::judge(const Motion& motion, double time, double dt,
                                         const std::function<void()>& sync, std::uint32_t pass) {
  requests_.clear();
  if (Diagnostic error = criteria_.judge(motion, time, dt, sync, requests_)) return error;
  drop_spent(pass);
  return std::nullopt;
}

MapChanges::Diagnostic MapChanges::tear(TearOutcome& outcome) {
  // A batch of which nothing fits any more leaves the map as it was judged: the next one's turn.
  while (!requests_.empty() && outcome.effects.touched.empty() && !outcome.error) {
    take_batch();
    tearing_.apply(batch_, outcome);
  }
  for (const TearEvent& event : outcome.events) ++applied_[event.pairing];
  release_holds(outcome.effects);
  return std::move(outcome.error);
}

void MapChanges::release_holds(const Effects& effects) {
  if (holds_.empty() || effects.touched.empty()) return;
  const auto fixed = state_.program.schema.find("fixed");
  const OrbitType vertex = OrbitType::cell(0, state_.map.dimension());
  const double no = 0;
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    std::vector<DartId>& darts = holds_[i];
    std::erase_if(darts, [&](DartId d) { return !state_.map.alive(d); });
    std::vector<DartId> parts;
    for (const DartId d : darts) {
      const DartId part = gmap::smallest_dart(state_.map, vertex, d);
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    }
    if (parts.size() < 2) continue;
    std::sort(parts.begin(), parts.end());
    const bool keep_first = model_.holds[i].on_split == OnSplit::KeepFirst;
    for (std::size_t k = keep_first ? 1 : 0; k < parts.size(); ++k)
      state_.store.set(*fixed, parts[k], {&no, 1});
    if (!keep_first) {
      darts.clear();
      continue;
    }
    std::erase_if(darts, [&](DartId d) {
      return gmap::smallest_dart(state_.map, vertex, d) != parts.front();
    });
  }
}

}  // namespace gmsim::engine
