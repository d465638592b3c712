// SPDX-License-Identifier: MIT
#include "compile/rewrite_plan.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

#include "compile/compile.h"

namespace gmsim::compile {

bool RewritePlan::removes() const {
  return std::any_of(changes.begin(), changes.end(),
                     [](const ColumnChange& change) { return change.fate == NodeFate::Removed; });
}

bool RewritePlan::affects(OrbitType type) const {
  return creates() || removes() || type.meets(changed_links);
}

const OrbitClasses* RewritePlan::find_orbits(OrbitType type) const {
  const auto found = std::find_if(orbits.begin(), orbits.end(),
                                  [&](const OrbitClasses& entry) { return entry.type == type; });
  return found == orbits.end() ? nullptr : &*found;
}

namespace {

/// The nodes that links of the orbit type join to `node` within a row.
std::vector<bool> orbit_class(const check::Pattern& pattern, check::NodeIndex node,
                              OrbitType orbit) {
  std::vector<bool> member(pattern.nodes.size(), false);
  member[node] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (const check::PatternArc& arc : pattern.arcs) {
      if (!orbit.contains(arc.dimension) || member[arc.a] == member[arc.b]) continue;
      member[arc.a] = member[arc.b] = grown = true;
    }
  }
  return member;
}

/// The label positions that stay inside of the orbits of a class: they join its rows.
std::vector<std::uint32_t> joined_positions(const check::Pattern& pattern,
                                            const std::vector<bool>& member, OrbitType orbit) {
  std::vector<std::uint32_t> joined;
  const auto node = static_cast<std::size_t>(std::find(member.begin(), member.end(), true) -
                                             member.begin());
  for (std::uint32_t p = 0; p < pattern.nodes[node].label.size(); ++p) {
    for (std::size_t other = 0; other < member.size(); ++other) {
      const std::int8_t entry = pattern.nodes[other].label[p];
      if (!member[other] || entry == check::kBlank || !orbit.contains(entry)) continue;
      joined.push_back(p);
      break;
    }
  }
  return joined;
}

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
      list_orbits();
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

  void list_orbits() {
    for (std::size_t i = 0; i < schema_.size(); ++i) {
      const OrbitType type = schema_[static_cast<EmbeddingId>(i)].orbit;
      if (plan_.find_orbits(type) == nullptr) plan_.orbits.push_back({type, classes_of(type)});
    }
  }

  std::vector<OrbitClass> classes_of(OrbitType type) const {
    std::vector<OrbitClass> classes;
    std::vector<bool> seen(rule_.right.nodes.size(), false);
    for (check::NodeIndex node = 0; node < seen.size(); ++node) {
      if (seen[node]) continue;
      const std::vector<bool> member = orbit_class(rule_.right, node, type);
      std::transform(seen.begin(), seen.end(), member.begin(), seen.begin(), std::logical_or<>());
      if (auto found = class_of(member, type)) classes.push_back(std::move(*found));
    }
    OrbitClass removed;
    for (const ColumnChange& change : plan_.changes) {
      if (change.fate == NodeFate::Removed) removed.columns.push_back(change.column);
    }
    if (!removed.columns.empty()) classes.push_back(std::move(removed));
    return classes;
  }

  /// Nothing when no dart of the class is touched.
  std::optional<OrbitClass> class_of(const std::vector<bool>& member, OrbitType type) const {
    std::vector<Column> all, created, touched;
    std::optional<Column> preserved;
    for (std::size_t node = 0; node < member.size(); ++node) {
      if (!member[node]) continue;
      const Column column = columns_[node];
      const bool is_new = column >= plan_.kept_columns;
      all.push_back(column);
      if (is_new) created.push_back(column);
      if (is_new || type.meets(links_[column])) touched.push_back(column);
      if (!is_new && !preserved) preserved = column;
    }
    if (touched.empty()) return std::nullopt;
    std::vector<std::uint32_t> joined = joined_positions(rule_.right, member, type);
    if (preserved && keeps_orbits(member, *preserved, joined, type)) {
      return OrbitClass{OrbitClass::Fate::Kept, std::move(created), *preserved, std::move(joined)};
    }
    if (!is_whole(member, type)) return OrbitClass{OrbitClass::Fate::Open, std::move(touched), 0};
    return OrbitClass{OrbitClass::Fate::Whole, std::move(all), 0, std::move(joined)};
  }

  /// Does the right side name all links of the type at all nodes of the class?
  [[nodiscard]] bool is_whole(const std::vector<bool>& member, OrbitType type) const {
    for (check::NodeIndex node = 0; node < member.size(); ++node) {
      if (!member[node]) continue;
      OrbitType links;
      for (const std::int8_t entry : rule_.right.nodes[node].label) {
        if (entry != check::kBlank) links.insert(entry);
      }
      for (const check::PatternArc& arc : rule_.right.arcs) {
        if (arc.a == node || arc.b == node) links.insert(arc.dimension);
      }
      if (!links.contains(type)) return false;
    }
    return true;
  }

  /// Are the same kept darts joined before and after? Within the match those of one class in the
  /// rows of one group are, on either side; links to other darts stay.
  [[nodiscard]] bool keeps_orbits(const std::vector<bool>& right, Column preserved,
                                  const std::vector<std::uint32_t>& joined,
                                  OrbitType type) const {
    const std::vector<bool> left = orbit_class(rule_.left, preserved, type);
    for (check::NodeIndex node = 0; node < left.size(); ++node) {
      const auto image = rule_.left_to_right[node];
      if (left[node] && !image) return false;
      if (image && right[*image] != left[node]) return false;
    }
    return joined_positions(rule_.left, left, type) == joined;
  }

  void add_assignment(const check::Assignment& assignment) {
    const OrbitType orbit = schema_[assignment.embedding].orbit;
    std::vector<std::uint32_t> joined = joined_positions(
        rule_.right, orbit_class(rule_.right, assignment.node, orbit), orbit);
    plan_.assignments.push_back({columns_[assignment.node], assignment.embedding, assignment.value,
                                 std::move(joined), assignment.target_span, assignment.span});
  }

  /// The classes of right nodes, for one orbit type, that hold created nodes only.
  std::vector<std::vector<bool>> created_classes(OrbitType orbit) const {
    std::vector<std::vector<bool>> classes;
    std::vector<bool> seen(rule_.right.nodes.size(), false);
    for (check::NodeIndex node = 0; node < seen.size(); ++node) {
      if (seen[node]) continue;
      std::vector<bool> member = orbit_class(rule_.right, node, orbit);
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
