// SPDX-License-Identifier: MIT
#include "compile/rewrite_plan.h"

#include <algorithm>
#include <map>

#include "compile/compile.h"

namespace gmsim::compile {

bool RewritePlan::removes() const {
  return std::any_of(changes.begin(), changes.end(),
                     [](const ColumnChange& change) { return change.fate == NodeFate::Removed; });
}

bool RewritePlan::affects(OrbitType type) const {
  return creates() || removes() || type.meets(changed_links);
}

namespace {

bool has_arc(const check::Pattern& pattern, int dimension, check::NodeIndex a, check::NodeIndex b) {
  return std::any_of(pattern.arcs.begin(), pattern.arcs.end(), [&](const check::PatternArc& arc) {
    return arc.dimension == dimension &&
           ((arc.a == a && arc.b == b) || (arc.a == b && arc.b == a));
  });
}

/// Compares the two sides of a rule.
class RewriteCompiler {
 public:
  RewriteCompiler(const check::Rule& rule, const gmap::EmbeddingSchema& schema)
      : rule_(rule), schema_(schema) {}

  RewritePlan run() {
    name_columns();
    if (rule_.has_right) {
      write_labels();
      write_arcs();
      list_changes();
    }
    for (const check::Assignment& assignment : rule_.assignments) add_assignment(assignment);
    if (plan_.creates()) list_unassigned();
    return std::move(plan_);
  }

 private:
  void name_columns() {
    plan_.kept_columns = static_cast<std::uint32_t>(rule_.left.nodes.size());
    for (check::NodeIndex node = 0; node < rule_.right.nodes.size(); ++node) {
      const auto left = rule_.right_to_left[node];
      columns_.push_back(left ? *left : plan_.kept_columns + plan_.created_columns++);
      if (!left) plan_.created_names.push_back(rule_.right.nodes[node].name);
    }
    links_.resize(plan_.kept_columns + plan_.created_columns);
  }

  void write_labels() {
    for (check::NodeIndex node = 0; node < rule_.right.nodes.size(); ++node) {
      const auto& label = rule_.right.nodes[node].label;
      const auto left = rule_.right_to_left[node];
      for (std::uint32_t p = 0; p < label.size(); ++p) {
        const std::int8_t entry = label[p];
        if (entry == check::kBlank) continue;
        if (left && rule_.left.nodes[*left].label[p] == entry) continue;
        write({entry, columns_[node], columns_[node], static_cast<std::int32_t>(p)});
      }
    }
  }

  void write_arcs() {
    for (const check::PatternArc& arc : rule_.right.arcs) {
      const auto left_a = rule_.right_to_left[arc.a], left_b = rule_.right_to_left[arc.b];
      if (left_a && left_b && has_arc(rule_.left, arc.dimension, *left_a, *left_b)) continue;
      write({static_cast<std::int8_t>(arc.dimension), columns_[arc.a], columns_[arc.b],
             LinkWrite::kExplicit});
    }
  }

  void write(LinkWrite link) {
    plan_.writes.push_back(link);
    const bool loop = link.position == LinkWrite::kExplicit && link.from == link.to;
    if (!loop) plan_.made_links.insert(link.dimension);
    links_[link.from].insert(link.dimension);
    links_[link.to].insert(link.dimension);
  }

  void list_changes() {
    const OrbitType all = OrbitType::range(0, rule_.dimension);
    for (Column column = 0; column < links_.size(); ++column) {
      NodeFate fate = NodeFate::Created;
      if (column < plan_.kept_columns) {
        fate = rule_.left_to_right[column] ? NodeFate::Preserved : NodeFate::Removed;
      }
      const OrbitType links = fate == NodeFate::Preserved ? links_[column] : all;
      if (links.empty()) continue;
      plan_.changes.push_back({column, fate, links});
      plan_.changed_links = OrbitType::from_bits(
          static_cast<std::uint8_t>(plan_.changed_links.bits() | links.bits()));
    }
  }

  /// The right nodes that links of the orbit type join to `node`.
  std::vector<bool> orbit_class(check::NodeIndex node, OrbitType orbit) const {
    std::vector<bool> member(rule_.right.nodes.size(), false);
    member[node] = true;
    for (bool grown = true; grown;) {
      grown = false;
      for (const check::PatternArc& arc : rule_.right.arcs) {
        if (!orbit.contains(arc.dimension) || member[arc.a] == member[arc.b]) continue;
        member[arc.a] = member[arc.b] = grown = true;
      }
    }
    return member;
  }

  void add_assignment(const check::Assignment& assignment) {
    const OrbitType orbit = schema_[assignment.embedding].orbit;
    const std::vector<bool> member = orbit_class(assignment.node, orbit);
    const auto& nodes = rule_.right.nodes;
    std::vector<std::uint32_t> joined;
    for (std::uint32_t p = 0; p < nodes[assignment.node].label.size(); ++p) {
      bool active = false;
      for (check::NodeIndex node = 0; node < nodes.size(); ++node) {
        const std::int8_t entry = nodes[node].label[p];
        active = active || (member[node] && entry != check::kBlank && orbit.contains(entry));
      }
      if (active) joined.push_back(p);
    }
    plan_.assignments.push_back({columns_[assignment.node], assignment.embedding, assignment.value,
                                 std::move(joined), assignment.target_span, assignment.span});
  }

  /// The classes of right nodes, for one orbit type, that hold created nodes only.
  std::vector<std::vector<bool>> created_classes(OrbitType orbit) const {
    std::vector<std::vector<bool>> classes;
    std::vector<bool> seen(rule_.right.nodes.size(), false);
    for (check::NodeIndex node = 0; node < seen.size(); ++node) {
      if (seen[node]) continue;
      std::vector<bool> member = orbit_class(node, orbit);
      bool created = true;
      for (check::NodeIndex other = 0; other < member.size(); ++other) {
        if (!member[other]) continue;
        seen[other] = true;
        created = created && !rule_.right_to_left[other];
      }
      if (created) classes.push_back(std::move(member));
    }
    return classes;
  }

  void list_unassigned() {
    std::map<OrbitType, std::vector<std::vector<bool>>> classes;
    for (std::size_t i = 0; i < schema_.size(); ++i) {
      const auto id = static_cast<EmbeddingId>(i);
      const OrbitType orbit = schema_[id].orbit;
      if (schema_[id].kind == gmap::EmbeddingKind::Derived) continue;
      const auto [entry, added] = classes.try_emplace(orbit);
      if (added) entry->second = created_classes(orbit);
      const bool lacks = std::any_of(
          entry->second.begin(), entry->second.end(), [&](const std::vector<bool>& member) {
            return std::none_of(rule_.assignments.begin(), rule_.assignments.end(),
                                [&](const check::Assignment& assignment) {
                                  return assignment.embedding == id && member[assignment.node];
                                });
          });
      if (lacks) plan_.unassigned.push_back(id);
    }
  }

  const check::Rule& rule_;
  const gmap::EmbeddingSchema& schema_;
  RewritePlan plan_;
  std::vector<Column> columns_;   // of right nodes
  std::vector<OrbitType> links_;  // written, by column
};

}  // namespace

RewritePlan compile_rewrite(const check::Rule& rule, const gmap::EmbeddingSchema& schema) {
  return RewriteCompiler(rule, schema).run();
}

}  // namespace gmsim::compile
