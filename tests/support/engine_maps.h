// SPDX-License-Identifier: MIT
// From the tables of the oracles to what the engine works on.
#pragma once

#include <algorithm>
#include <vector>

#include "check/checked_rule.h"
#include "compile/compile.h"
#include "engine/matcher.h"
#include "gmap/gmap.h"
#include "support/tiny_map.h"

namespace gmsim::tests {

inline gmap::GMap to_gmap(const TinyMap& tiny) {
  gmap::GMap map(tiny.dimension);
  map.add_darts(static_cast<std::uint32_t>(tiny.size()));
  std::vector<types::DartId> dead;
  for (int d = 0; d < tiny.size(); ++d) {
    if (tiny.dead[d]) {
      dead.push_back(static_cast<types::DartId>(d));
      continue;
    }
    for (int i = 0; i <= tiny.dimension; ++i) {
      map.set_alpha(i, static_cast<types::DartId>(d), static_cast<types::DartId>(tiny.links[d][i]));
    }
  }
  map.remove_darts(dead);
  return map;
}

inline std::vector<types::DartId> to_darts(const std::vector<int>& darts) {
  std::vector<types::DartId> result;
  for (int d : darts) result.push_back(static_cast<types::DartId>(d));
  return result;
}

/// A pattern that the compiler promises to handle: labels of one length, full at the hooks, links
/// of the map's dimension, every node connected to a hook.
inline bool can_compile(const check::Pattern& pattern, const std::vector<check::NodeIndex>& hooks,
                        int dimension) {
  for (const check::PatternNode& node : pattern.nodes) {
    if (node.label.size() != pattern.nodes.front().label.size()) return false;
    if (std::any_of(node.label.begin(), node.label.end(), [&](int i) { return i > dimension; })) {
      return false;
    }
  }
  std::vector<bool> known(pattern.nodes.size(), false);
  for (check::NodeIndex hook : hooks) {
    known[hook] = true;
    const auto& label = pattern.nodes[hook].label;
    if (std::count(label.begin(), label.end(), check::kBlank) > 0) return false;
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (const check::PatternArc& arc : pattern.arcs) {
      if (arc.dimension > dimension) return false;
      if (known[arc.a] == known[arc.b]) continue;
      known[arc.a] = known[arc.b] = grown = true;
    }
    for (const check::PatternPath& path : pattern.paths) {
      if (known[path.from] == known[path.to]) continue;
      known[path.from] = known[path.to] = grown = true;
    }
  }
  return std::find(known.begin(), known.end(), false) == known.end();
}

/// A slot for each node of the left side, as the checker gives them.
inline check::Rule with_slots(check::Rule rule) {
  rule.frame_size = static_cast<std::uint32_t>(rule.left.nodes.size());
  for (std::uint32_t k = 0; k < rule.frame_size; ++k) rule.left.nodes[k].slot = types::Slot{k};
  return rule;
}

/// The rows of a match and where each position leads, whatever the order of rows: for each row its
/// node darts, then those of the rows that its positions lead to.
inline std::vector<std::vector<types::DartId>> row_set(const engine::Match& match,
                                                       std::size_t nodes) {
  std::vector<std::vector<types::DartId>> rows;
  for (std::uint32_t row = 0; row < match.rows; ++row) {
    std::vector<types::DartId> all;
    const auto append = [&](std::uint32_t r) {
      for (std::uint32_t c = 0; c < nodes; ++c) all.push_back(match.dart(r, c));
    };
    append(row);
    for (std::uint32_t p = 0; p < match.positions; ++p) append(match.next_row(row, p));
    rows.push_back(std::move(all));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace gmsim::tests
