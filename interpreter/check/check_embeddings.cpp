// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <map>

#include "check/check_invariance.h"
#include "check/passes.h"

namespace gmsim::check {
namespace {

using gmap::EmbeddingDecl;
using gmap::EmbeddingKind;
using gmap::EmbeddingRole;
using gmap::MergePolicy;
using support::Diagnostic;
using support::DiagnosticKind;

/// The orbits of one type before and after a rule.
struct OrbitChange {
  OrbitClasses before;
  OrbitClasses after;
  std::vector<std::vector<NodeIndex>> members;  ///< right nodes by class after, named by the first
};

class EmbeddingChecker {
 public:
  EmbeddingChecker(const Rule& rule, const gmap::EmbeddingSchema& schema,
                   support::Diagnostics& diagnostics)
      : rule_(rule),
        schema_(schema),
        diagnostics_(diagnostics),
        old_(rule.left, rule.dimension),
        new_(rule, old_),
        invariance_(rule, old_, schema) {}

  bool run() {
    bool good = true;
    for (std::uint32_t id = 0; id < schema_.size(); ++id) {
      const EmbeddingDecl& embedding = schema_[types::EmbeddingId{id}];
      if (embedding.kind == EmbeddingKind::Derived || embedding.role == EmbeddingRole::Result)
        continue;
      const OrbitChange& change = change_of(embedding.orbit);
      std::map<NodeIndex, std::vector<const Assignment*>> assigned;
      for (const Assignment& assignment : rule_.assignments)
        if (types::index(assignment.embedding) == id)
          assigned[change.after.of(assignment.node)].push_back(&assignment);
      for (NodeIndex node = 0; node < rule_.right.nodes.size(); ++node)
        if (!change.members[node].empty())
          good &= check_class(embedding, node, assigned[node], change);
    }
    return good;
  }

 private:
  const OrbitChange& change_of(types::OrbitType type) {
    const auto found = changes_.find(type);
    if (found != changes_.end()) return found->second;
    OrbitChange change{OrbitClasses::before(rule_.left, old_, type),
                       OrbitClasses::after(new_, old_, type),
                       std::vector<std::vector<NodeIndex>>(rule_.right.nodes.size())};
    for (NodeIndex node = 0; node < rule_.right.nodes.size(); ++node)
      change.members[change.after.of(node)].push_back(node);
    return changes_.emplace(type, std::move(change)).first->second;
  }

  bool check_class(const EmbeddingDecl& embedding, NodeIndex first,
                   const std::vector<const Assignment*>& assigned, const OrbitChange& change) {
    if (!assigned.empty()) {
      bool good = one_value(assigned, embedding);
      for (const Assignment* assignment : assigned)
        good = good && invariance_.check(*assignment, change.after.joined(first), diagnostics_);
      return good;
    }
    const std::vector<NodeIndex>& nodes = change.members[first];
    for (const NodeIndex node : nodes)
      if (rule_.right_to_left[node]) return merges(embedding, nodes, node, change);
    return starts(embedding, nodes.front());
  }

  /// E2.
  bool one_value(const std::vector<const Assignment*>& assigned, const EmbeddingDecl& embedding) {
    for (std::size_t k = 1; k < assigned.size(); ++k) {
      if (invariance_.equal(*assigned[0]->value, *assigned[k]->value)) continue;
      const std::string &a = name(assigned[0]->node), &b = name(assigned[k]->node);
      Diagnostic error{DiagnosticKind::SeveralValues,
                       a == b ? fmt::format("`{}.{}` is given two values", b, embedding.name)
                              : fmt::format("one {} is given two values: `{}` and `{}` lie in it",
                                            words(embedding), a, b),
                       assigned[k]->target_span};
      error.related.push_back({assigned[0]->target_span, "first value"});
      error.help = fmt::format("keep one of the values of `{}`", embedding.name);
      diagnostics_.report(std::move(error));
      return false;
    }
    return true;
  }

  /// E1: an orbit of created darts only.
  bool starts(const EmbeddingDecl& embedding, NodeIndex node) {
    // What an interaction stores on a new orbit comes from the scene.
    if (embedding.optional || embedding.default_value || embedding.role != EmbeddingRole::Data)
      return true;
    diagnostics_.report({DiagnosticKind::MissingValue,
                         fmt::format("`{}` has no value on the {} that the rule creates at `{}`",
                                     embedding.name, words(embedding), name(node)),
                         rule_.right.nodes[node].span,
                         {},
                         {},
                         fmt::format("write `{}.{} = …;`, or give `{}` a default", name(node),
                                     embedding.name, embedding.name)});
    return false;
  }

  /// E3 and E4: an orbit that holds darts of several old ones.
  bool merges(const EmbeddingDecl& embedding, const std::vector<NodeIndex>& nodes, NodeIndex kept,
              const OrbitChange& change) {
    if (embedding.kind == EmbeddingKind::Extensive || embedding.merge != MergePolicy::None ||
        embedding.role != EmbeddingRole::Data)
      return true;
    const NodeIndex before = *rule_.right_to_left[kept];
    for (const NodeIndex node : nodes) {
      const std::optional<NodeIndex>& other = rule_.right_to_left[node];
      if (!other || change.before.of(*other) == change.before.of(before)) continue;
      Diagnostic error = several(embedding, node,
                                 fmt::format("the {} of `{}` and that of `{}` become one",
                                             words(embedding), name(kept), name(node)));
      error.related.push_back({rule_.right.nodes[kept].span, fmt::format("`{}`", name(kept))});
      diagnostics_.report(std::move(error));
      return false;
    }
    const Positions joined = change.after.joined(kept) & ~change.before.joined(before);
    if (joined == 0) return true;
    diagnostics_.report(several(
        embedding, kept,
        fmt::format("{} of `{}` that were apart become one", plural(embedding), name(kept))));
    return false;
  }

  Diagnostic several(const EmbeddingDecl& embedding, NodeIndex node,
                     const std::string& what) const {
    Diagnostic error{DiagnosticKind::UnresolvedMerge,
                     fmt::format("{}, each with its own `{}`", what, embedding.name),
                     rule_.right.nodes[node].span};
    error.help = fmt::format("write `{}.{} = …;`, or declare `{}` with `merge mean` or the like",
                             name(node), embedding.name, embedding.name);
    return error;
  }

  const std::string& name(NodeIndex node) const { return rule_.right.nodes[node].name; }
  std::string words(const EmbeddingDecl& embedding) const {
    return orbit_in_words(embedding.orbit, rule_.dimension);
  }
  std::string plural(const EmbeddingDecl& embedding) const {
    const std::string one = words(embedding);
    if (one == "vertex") return "vertices";
    return one.starts_with("orbit") ? "orbits" + one.substr(5) : one + "s";
  }

  const Rule& rule_;
  const gmap::EmbeddingSchema& schema_;
  support::Diagnostics& diagnostics_;
  KnownLinks old_;
  NewLinks new_;
  InvarianceChecker invariance_;
  std::map<types::OrbitType, OrbitChange> changes_;
};

}  // namespace

bool check_embeddings(const Rule& rule, const gmap::EmbeddingSchema& schema,
                      support::Diagnostics& diagnostics) {
  return EmbeddingChecker(rule, schema, diagnostics).run();
}

}  // namespace gmsim::check
