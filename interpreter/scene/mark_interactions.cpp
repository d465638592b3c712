// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <unordered_map>

#include "engine/enumerate.h"
#include "gmap/orbit_walk.h"
#include "scene/acting.h"

namespace gmsim::scene {
namespace {

using gmap::DartId;
using support::DiagnosticKind;
using support::Severity;

class Marker {
 public:
  Marker(Building& building, engine::Matcher& matcher)
      : building_(building), matcher_(matcher), evaluator_(building) {}

  void mark(const InteractionUse& use) {
    std::vector<bool> claimed;  // by dart: an earlier member of the family has its element
    if (use.family) claimed.resize(building_.state().map.dart_end(), false);
    std::size_t marked = 0;
    for (const InteractionUse::Member& member : use.members) {
      const std::vector<DartId> darts = matches(use, member, claimed);
      if (failed()) return;
      marked += darts.size();
      if (!carry(use, member, darts)) return;
      for (const DartId dart : use.family ? darts : std::vector<DartId>{})
        gmap::for_each_dart(building_.state().map, pattern(member).orbit, dart,
                            [&](DartId d) { claimed[types::index(d)] = true; });
    }
    if (use.family) require_all(use, claimed);
    if (marked == 0 && !failed())
      building_.report(DiagnosticKind::EmptySelection, use.span,
                       fmt::format("`{}` acts nowhere{}", use.name, body_text(use)),
                       "its pattern matches no orbit where `where` holds", Severity::Warning);
  }

  [[nodiscard]] bool failed() const { return building_.diagnostics.has_errors(); }
  [[nodiscard]] ActingInteractions take() { return std::move(acting_); }

 private:
  [[nodiscard]] const compile::RootedPattern& pattern(const InteractionUse::Member& member) const {
    return building_.scene.program.interactions[member.interaction];
  }
  [[nodiscard]] std::string body_text(const InteractionUse& use) const {
    return use.body ? fmt::format(" in `{}`", building_.plan.bodies[*use.body].name) : "";
  }

  [[nodiscard]] bool chosen(const InteractionUse& use, const std::vector<bool>& claimed,
                            DartId dart) {
    if (!claimed.empty() && claimed[types::index(dart)]) return false;
    return building_.in_body(dart, use.body) && evaluator_.holds(use.where, dart);
  }

  /// One dart of each orbit where the member acts. Which dart of the orbit the match starts from is
  /// decided later, when the marks are there.
  std::vector<DartId> matches(const InteractionUse& use, const InteractionUse::Member& member,
                              const std::vector<bool>& claimed) {
    const compile::RootedPattern& item = pattern(member);
    std::vector<DartId> darts;
    const engine::Enumeration enumeration{
        .orbit = item.orbit, .where = [&](DartId dart) { return chosen(use, claimed, dart); }};
    const auto error = engine::for_each_match(
        matcher_, building_.state(), item.match, item.frame_size, {}, enumeration,
        [&](DartId dart, const engine::Match&, engine::Frame&) { darts.push_back(dart); });
    if (error) building_.diagnostics.report(*error);
    return darts;
  }

  /// Sets the marks; an orbit carries an interaction once.
  bool carry(const InteractionUse& use, const InteractionUse::Member& member,
             const std::vector<DartId>& darts) {
    if (darts.empty()) return true;
    const types::EmbeddingId presence = *pattern(member).presence;
    building_.state().use(presence);
    const gmap::OrbitIndex& rows = building_.state().store.index_of(presence);
    Acting& acting = acting_[member.interaction];
    acting.use_of_row.resize(rows.row_end(), Acting::kNoUse);
    const auto number = static_cast<std::uint32_t>(acting.uses.size());
    for (const DartId dart : darts) {
      std::uint32_t& owner = acting.use_of_row[rows.row(dart)];
      if (owner != Acting::kNoUse) {
        report_twice(use, *acting.uses[owner].use, member, dart);
        return false;
      }
      owner = number;
      const double mark = 1;
      building_.state().store.set(presence, dart, {&mark, 1});
    }
    acting.uses.push_back({&use, &member});
    return true;
  }

  void report_twice(const InteractionUse& use, const InteractionUse& other,
                    const InteractionUse::Member& member, DartId dart) {
    building_.diagnostics.report(
        {.kind = DiagnosticKind::Conflict,
         .message = fmt::format("`{}` acts twice at {}", pattern(member).name,
                                dart_text(building_.state(), dart)),
         .place = use.span,
         .related = {{other.span, "here too"}},
         .help = "let `where` or `body` tell them apart: an orbit carries an interaction once"});
  }

  /// An element for which a family has no law would have no stiffness, which nobody means.
  void require_all(const InteractionUse& use, const std::vector<bool>& claimed) {
    if (use.members.empty()) return;
    std::size_t missing = 0;
    DartId first = gmap::kNoDart;
    for (const DartId orbit :
         gmap::all_orbits(building_.state().map, pattern(use.members[0]).orbit)) {
      bool wanted = false;
      gmap::for_each_dart(
          building_.state().map, pattern(use.members[0]).orbit, orbit, [&](DartId dart) {
            wanted = wanted || (!claimed[types::index(dart)] && chosen(use, claimed, dart));
          });
      if (!wanted || claimed[types::index(orbit)]) continue;
      if (missing++ == 0) first = orbit;
    }
    if (missing > 0 && !failed())
      building_.report(
          DiagnosticKind::NoMatch, use.span,
          fmt::format("no member of the family `{}` fits {} of the elements, the first with {}",
                      use.name, missing, dart_text(building_.state(), first)),
          "exclude them with `where`");
  }

  Building& building_;
  engine::Matcher& matcher_;
  DartEvaluator evaluator_;
  ActingInteractions acting_;
};

/// A criterion of an interaction that acts nowhere.
void warn_of_silence(Building& building, const engine::TearPairing& tear) {
  const compile::Program& program = building.scene.program;
  const compile::CriterionBody& body = program.criterion_bodies[tear.criterion];
  if (!body.interaction) return;
  std::string name;
  for (std::uint32_t i = 0; i < program.interaction_bodies.size(); ++i)
    if (program.interaction_bodies[i].id == *body.interaction) name = program.interactions[i].name;
  const auto acts = [&](const engine::ActiveInteraction& active) {
    return program.interaction_bodies[active.interaction].id == *body.interaction;
  };
  if (std::ranges::any_of(building.scene.model.interactions, acts)) return;
  building.report(DiagnosticKind::EmptySelection, tear.span,
                  fmt::format("`{}` never fires: `{}` acts nowhere in this scene", body.name, name),
                  "give it under `interactions` of a body", Severity::Warning);
}

}  // namespace

ActingInteractions mark_interactions(Building& building, engine::Matcher& matcher) {
  Marker marker(building, matcher);
  for (const InteractionUse& use : building.plan.interactions) {
    marker.mark(use);
    if (marker.failed()) break;
  }
  return marker.take();
}

void bind_interactions(Building& building) {
  engine::Matcher matcher(building.state());
  const ActingInteractions acting = mark_interactions(building, matcher);
  if (building.plan.bodies.size() > 1) building.scene.model.body_of_dart = building.dart_body;
  for (const auto& [interaction, uses] : acting) {
    if (building.diagnostics.has_errors()) return;
    if (auto active = bind_parameters(building, matcher, interaction, uses))
      building.scene.model.interactions.push_back(std::move(*active));
  }
  for (const engine::TearPairing& tear : building.scene.model.tears) warn_of_silence(building, tear);
}

}  // namespace gmsim::scene
