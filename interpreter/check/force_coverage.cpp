// SPDX-License-Identifier: MIT
#include "check/force_coverage.h"

#include <algorithm>
#include <map>
#include <set>

#include "check/differentiable.h"
#include "check/known_darts.h"
#include "check/make_expr.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::Expr;
namespace {

/// Some dart of `orbit` of a known dart; with `vertex_only`, a dart of the same vertex as that one.
struct DartSet {
  KnownDarts::Id dart = 0;
  OrbitType orbit;
  bool vertex_only = false;
};
/// Everything that a dart expression may be; empty: not known.
using DartSets = std::vector<DartSet>;

OrbitType merged(OrbitType a, OrbitType b) {
  return OrbitType::from_bits(static_cast<std::uint8_t>(a.bits() | b.bits()));
}

class Coverage {
 public:
  Coverage(const Interaction& interaction, ItemContext& context)
      : interaction_(interaction), context_(context),
        darts_(interaction.match, context.n()),
        position_(context.env.library->schema.find("position")) {
    for (NodeIndex i = 0; i < interaction.match.nodes.size(); ++i)
      sets_[interaction.match.nodes[i].slot] = {{.dart = darts_.of_node(i), .orbit = {}}};
    for (const Step& step : interaction.steps)
      if (step.kind == Step::Kind::Let) bound_[step.slot] = step.value;
  }

  void run() {
    for (const ForceLine& line : interaction_.forces) {
      if (line.collection) {
        for (const DartSet& set : collection(*line.collection, true)) targets_.push_back(set);
      } else {
        for (const ExprPtr& target : line.targets)
          for (const DartSet& set : dart_sets(*target)) targets_.push_back(set);
      }
    }
    visit(*interaction_.energy);
  }

 private:
  void visit(const Expr& expr) {
    if (!done_.insert(&expr).second || expr.kind == ExprKind::Frozen) return;
    if (expr.kind == ExprKind::Local) {
      if (const auto let = bound_.find(expr.slot); let != bound_.end()) visit(*let->second);
      return;
    }
    if (expr.kind == ExprKind::Let) bound_[expr.slot] = expr.args[0];
    if (expr.kind == ExprKind::Fold && has_kind(expr.args[0], ValueKind::Darts)) {
      sets_[expr.slot] = collection(*expr.args[0], false);
      collections_[expr.slot] = expr.args[0];
    }
    if (expr.kind == ExprKind::Embedding && position_ && expr.embedding == *position_)
      check_read(expr);
    for (const ExprPtr& arg : expr.args) visit(*arg);
  }

  DartSets dart_sets(const Expr& dart) {
    switch (dart.kind) {
      case ExprKind::Local: {
        if (const auto known = sets_.find(dart.slot); known != sets_.end()) return known->second;
        const auto let = bound_.find(dart.slot);
        return let == bound_.end() ? DartSets{} : dart_sets(*let->second);
      }
      case ExprKind::Alpha: {
        DartSets sets = dart_sets(*dart.args[0]);
        for (DartSet& set : sets) walk(set, dart.number);
        return sets;
      }
      case ExprKind::Let: bound_[dart.slot] = dart.args[0]; return dart_sets(*dart.args[1]);
      case ExprKind::If: {
        DartSets sets = dart_sets(*dart.args[1]);
        const DartSets other = dart_sets(*dart.args[2]);
        if (sets.empty() || other.empty()) return {};
        sets.insert(sets.end(), other.begin(), other.end());
        return sets;
      }
      case ExprKind::Fold:  // argmax and argmin give a dart
        sets_[dart.slot] = collection(*dart.args[0], false);
        return dart_sets(*dart.args.back());
      default: return {};
    }
  }

  void walk(DartSet& set, int link) {
    if (set.orbit.empty() && !set.vertex_only) {
      set.dart = darts_.walk(set.dart, link);
    } else if (set.vertex_only && link != 0) {
      return;
    } else if (set.vertex_only) {
      set = {set.dart, merged(merged(set.orbit, darts_.vertex()), OrbitType{link})};
    } else if (!set.orbit.contains(link)) {
      if (link == 0)
        set.orbit.insert(link);
      else
        set.vertex_only = true;
    }
  }

  /// Darts of a collection. `all_vertices`: only if each vertex that the orbit meets has one.
  DartSets collection(const Expr& darts, bool all_vertices) {
    OrbitType orbit = darts.orbit;
    if (darts.kind == ExprKind::Polygon) orbit = {0, 1};
    const bool known = darts.kind == ExprKind::Polygon || darts.kind == ExprKind::OrbitDarts ||
                       darts.kind == ExprKind::Quotient;
    const bool coarse = darts.kind == ExprKind::Quotient && darts.orbit2.contains(0);
    if (!known || (all_vertices && coarse)) return {};
    DartSets sets = dart_sets(*darts.args[0]);
    for (DartSet& set : sets) {
      if (set.vertex_only) set.orbit = merged(set.orbit, darts_.vertex());
      set.vertex_only = false;
      set.orbit = merged(set.orbit, orbit);
    }
    return sets;
  }

  /// The vertex of a dart belongs to one of the targets.
  bool vertex_covered(KnownDarts::Id dart) const {
    return std::ranges::any_of(targets_, [&](const DartSet& target) {
      return std::ranges::any_of(darts_.orbit(target.dart, target.orbit),
                                 [&](KnownDarts::Id at) { return darts_.same_vertex(at, dart); });
    });
  }

  bool covered(const DartSet& read) const {
    if (darts_.vertex().contains(read.orbit)) return vertex_covered(read.dart);
    const bool inside = std::ranges::any_of(targets_, [&](const DartSet& target) {
      return target.orbit.contains(read.orbit) &&
             darts_.orbit(target.dart, target.orbit).contains(read.dart);
    });
    if (inside) return true;
    return darts_.orbit_is_known(read.dart, read.orbit) &&
           std::ranges::all_of(darts_.orbit(read.dart, read.orbit),
                               [&](KnownDarts::Id at) { return vertex_covered(at); });
  }

  void check_read(const Expr& read) {
    const DartSets sets = dart_sets(*read.args[0]);
    if (!sets.empty() && std::ranges::all_of(sets, [&](const DartSet& s) { return covered(s); }))
      return;
    types::ExprNames names;
    names.slots = context_.slot_names;
    const std::string dart = to_string(*read.args[0], names);
    if (!reported_.insert(dart).second) return;
    std::string target = dart;
    if (const auto of = collections_.find(read.args[0]->slot);
        read.args[0]->kind == ExprKind::Local && of != collections_.end())
      target += " in " + to_string(*of->second, names);
    context_.report({.kind = DiagnosticKind::ForceMissing,
                     .message = "the energy reads the position of `" + dart +
                                "`, and no `force` line gives it a force",
                     .place = read.span,
                     .related = {{interaction_.energy->span, "the energy"}},
                     .help = "add `force " + target + " on dart;`, or hold the value with "
                             "`frozen(…)`"});
  }

  const Interaction& interaction_;
  ItemContext& context_;
  KnownDarts darts_;
  std::optional<EmbeddingId> position_;
  std::map<Slot, DartSets> sets_;
  std::map<Slot, ExprPtr> bound_;
  std::map<Slot, ExprPtr> collections_;  ///< what fold variables go over
  std::set<std::string> reported_;
  DartSets targets_;
  std::set<const Expr*> done_;
};

/// Whether a derived value reads forces, itself or through others that are not in `seen`.
bool reads_forces(const gmap::EmbeddingSchema& schema, EmbeddingId id,
                  std::set<EmbeddingId>& seen) {
  bool reads = false;
  if (!seen.insert(id).second) return false;
  for_each_node(schema[id].derivation, [&](const Expr& node) {
    reads |= node.kind == ExprKind::ForceOn || node.kind == ExprKind::Forces;
    if (node.kind == ExprKind::Embedding && !reads)
      reads = reads_forces(schema, node.embedding, seen);
  });
  return reads;
}

}  // namespace

void check_forces_start_somewhere(const Interaction& interaction, ItemContext& context) {
  const gmap::EmbeddingSchema& schema = context.env.library->schema;
  std::vector<ExprPtr> parts = {interaction.energy};
  for (const ForceLine& line : interaction.forces) parts.push_back(line.value);
  for (const Step& step : interaction.steps) parts.push_back(step.value);
  for (const ExprPtr& part : parts)
    for_each_node(part, [&](const Expr& node) {
      std::set<EmbeddingId> seen;
      if (node.kind != ExprKind::Embedding || !reads_forces(schema, node.embedding, seen)) return;
      context.report({.kind = DiagnosticKind::RecursiveDefinition,
                      .message = "a force cannot be computed from forces, and `" +
                                 schema[node.embedding].name + "` reads them",
                      .place = node.span,
                      .related = {{schema[node.embedding].span, "declared here"}}});
    });
}

void check_force_coverage(const Interaction& interaction, ItemContext& context) {
  if (!interaction.energy) return;
  check_differentiable(close_over(interaction.energy, interaction.steps), "an energy", context);
  if (context.good()) Coverage(interaction, context).run();
}

}  // namespace gmsim::check
