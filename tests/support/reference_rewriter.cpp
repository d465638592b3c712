// SPDX-License-Identifier: MIT
#include "support/reference_rewriter.h"

#include <algorithm>
#include <map>
#include <set>

namespace gmsim::tests {
namespace {

using check::kBlank;
using check::NodeIndex;
using check::Pattern;

class Matching {
 public:
  Matching(const TinyMap& map, const Pattern& left, const std::vector<NodeIndex>& hooks)
      : map_(map), left_(left), hooks_(hooks) {}

  std::optional<ReferenceMatch> run(const std::vector<int>& hook_darts) {
    if (!rows_of_hooks(hook_darts)) return std::nullopt;
    for (std::size_t row = 0; row < match_.darts.size(); ++row)
      if (!follow_arcs(row)) return std::nullopt;
    if (!labels_hold() || !all_distinct()) return std::nullopt;
    return std::move(match_);
  }

 private:
  int link(int i, int d) const { return map_.links[d][i]; }

  /// The rows: what is reached from the hooks by all their labels at once.
  bool rows_of_hooks(const std::vector<int>& hook_darts) {
    if (hooks_.empty()) {
      match_.darts.assign(left_.nodes.empty() ? 1 : 0, {});
      match_.next.assign(match_.darts.size(), {});
      return left_.nodes.empty();
    }
    const std::size_t positions = left_.nodes[hooks_[0]].label.size();
    std::map<int, int> row_of;  // by the first hook's dart
    std::vector<std::vector<int>> rows{hook_darts};
    row_of[hook_darts[0]] = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      match_.next.emplace_back();
      for (std::size_t p = 0; p < positions; ++p) {
        std::vector<int> moved;
        for (std::size_t h = 0; h < hooks_.size(); ++h)
          moved.push_back(link(left_.nodes[hooks_[h]].label[p], rows[row][h]));
        const auto [found, added] = row_of.emplace(moved[0], static_cast<int>(rows.size()));
        if (added) rows.push_back(moved);
        if (rows[found->second] != moved) return false;
        match_.next[row].push_back(found->second);
      }
    }
    for (const std::vector<int>& row : rows) {
      match_.darts.emplace_back(left_.nodes.size(), kNone);
      for (std::size_t h = 0; h < hooks_.size(); ++h) match_.darts.back()[hooks_[h]] = row[h];
    }
    return true;
  }

  /// Fills a row along arcs and paths, again and again until nothing is new, checking all of them.
  bool follow_arcs(std::size_t row) {
    std::vector<int>& darts = match_.darts[row];
    bool changed = true;
    const auto reach = [&](NodeIndex node, int dart) {
      if (darts[node] == dart) return true;
      if (darts[node] != kNone) return false;
      darts[node] = dart;
      changed = true;
      return true;
    };
    while (changed) {
      changed = false;
      for (const check::PatternArc& arc : left_.arcs) {
        if (darts[arc.a] != kNone && !reach(arc.b, link(arc.dimension, darts[arc.a]))) return false;
        if (darts[arc.b] != kNone && !reach(arc.a, link(arc.dimension, darts[arc.b]))) return false;
      }
      for (const check::PatternPath& path : left_.paths)
        if (!walk(path, darts, reach)) return false;
    }
    return std::count(darts.begin(), darts.end(), kNone) == 0;
  }

  template <class Reach>
  bool walk(const check::PatternPath& path, const std::vector<int>& darts, const Reach& reach) {
    if (darts[path.from] != kNone) {
      int dart = darts[path.from];
      for (const int i : path.dimensions) dart = link(i, dart);
      if (!reach(path.to, dart)) return false;
    }
    if (darts[path.to] != kNone) {
      int dart = darts[path.to];
      for (std::size_t k = path.dimensions.size(); k-- > 0;) dart = link(path.dimensions[k], dart);
      if (!reach(path.from, dart)) return false;
    }
    return true;
  }

  bool labels_hold() const {
    for (std::size_t row = 0; row < match_.darts.size(); ++row)
      for (NodeIndex node = 0; node < left_.nodes.size(); ++node)
        for (std::size_t p = 0; p < left_.nodes[node].label.size(); ++p) {
          const int i = left_.nodes[node].label[p];
          if (i == kBlank) continue;
          if (link(i, match_.darts[row][node]) != match_.darts[match_.next[row][p]][node])
            return false;
        }
    return true;
  }

  bool all_distinct() const {
    std::set<int> seen;
    for (const std::vector<int>& row : match_.darts)
      for (const int dart : row)
        if (!seen.insert(dart).second) return false;
    return true;
  }

  const TinyMap& map_;
  const Pattern& left_;
  const std::vector<NodeIndex>& hooks_;
  ReferenceMatch match_;
};

/// Calls f(dimension, row, node, other row, other node) for every end of every link of a side.
template <class Call>
void for_each_link(const Pattern& side, const std::vector<std::vector<int>>& next, Call f) {
  for (std::size_t row = 0; row < next.size(); ++row) {
    for (NodeIndex node = 0; node < side.nodes.size(); ++node)
      for (std::size_t p = 0; p < side.nodes[node].label.size(); ++p)
        if (side.nodes[node].label[p] != kBlank)
          f(side.nodes[node].label[p], row, node, static_cast<std::size_t>(next[row][p]), node);
    for (const check::PatternArc& arc : side.arcs) {
      f(arc.dimension, row, arc.a, row, arc.b);
      f(arc.dimension, row, arc.b, row, arc.a);
    }
  }
}

}  // namespace

std::optional<ReferenceMatch> reference_match(const TinyMap& map, const Pattern& left,
                                              const std::vector<NodeIndex>& hooks,
                                              const std::vector<int>& hook_darts) {
  return Matching(map, left, hooks).run(hook_darts);
}

ReferenceRewrite reference_rewrite(TinyMap map, const check::Rule& rule,
                                   const ReferenceMatch& match) {
  std::vector<std::vector<int>> right(match.darts.size());
  for (std::size_t row = 0; row < match.darts.size(); ++row)
    for (NodeIndex node = 0; node < rule.right.nodes.size(); ++node) {
      const std::optional<NodeIndex>& before = rule.right_to_left[node];
      right[row].push_back(before ? match.darts[row][*before] : map.add_dart());
    }
  for_each_link(rule.left, match.next,
                [&](int i, std::size_t row, NodeIndex node, std::size_t, NodeIndex) {
                  map.links[match.darts[row][node]][i] = kNone;
                });
  for_each_link(rule.right, match.next,
                [&](int i, std::size_t row, NodeIndex node, std::size_t to, NodeIndex other) {
                  map.links[right[row][node]][i] = right[to][other];
                });
  for (const std::vector<int>& row : match.darts)
    for (NodeIndex node = 0; node < rule.left.nodes.size(); ++node)
      if (!rule.left_to_right[node]) map.dead[row[node]] = true;
  return {std::move(map), std::move(right)};
}

std::vector<int> reference_orbits(const TinyMap& map, types::OrbitType type) {
  std::vector<int> orbit(map.links.size(), kNone);
  for (int start = 0; start < map.size(); ++start) {
    if (map.dead[start] || orbit[start] != kNone) continue;
    std::vector<int> todo{start};
    orbit[start] = start;
    while (!todo.empty()) {
      const int d = todo.back();
      todo.pop_back();
      for (int i = 0; i <= map.dimension; ++i) {
        if (!type.contains(i) || orbit[map.links[d][i]] != kNone) continue;
        orbit[map.links[d][i]] = start;
        todo.push_back(map.links[d][i]);
      }
    }
  }
  return orbit;
}

}  // namespace gmsim::tests
