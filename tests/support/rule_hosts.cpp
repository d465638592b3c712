// SPDX-License-Identifier: MIT
#include "support/rule_hosts.h"

#include <cstdlib>

namespace gmsim::tests {
namespace {

using check::kBlank;
using check::NodeIndex;
using check::PatternArc;
using check::PatternNode;
using check::Rule;

/// Rows for the label positions: involutions that commute where some node's links do.
std::optional<PartialTable> random_rows(const Rule& rule, Random& random) {
  const std::size_t positions = rule.left.nodes.empty() ? 0 : rule.left.nodes.front().label.size();
  std::vector<std::vector<bool>> commute(4, std::vector<bool>(4, false));
  for (const PatternNode& node : rule.left.nodes)
    for (std::size_t p = 0; p < positions; ++p)
      for (std::size_t q = 0; q < positions; ++q)
        if (node.label[p] != kBlank && node.label[q] != kBlank &&
            std::abs(node.label[p] - node.label[q]) >= 2)
          commute[p][q] = true;
  PartialTable rows(static_cast<int>(positions), std::move(commute));
  rows.add();
  PartialTable::Style style;
  style.loop = 0.15 * static_cast<double>(below(random, 3));
  style.join = 0.25;
  style.soft_limit = 1 + below(random, 8);
  if (chance(random, 0.1)) style.loop = 1.0;
  if (positions > 0 && !rows.complete(random, style)) return std::nullopt;
  return rows;
}

/// The darts of `left` in every row with their links; false when they contradict each other.
bool instantiate(const Rule& rule, const PartialTable& rows, PartialTable& table) {
  const int nodes = static_cast<int>(rule.left.nodes.size());
  for (int k = 0; k < nodes * rows.size(); ++k) table.add();
  for (int row = 0; row < rows.size(); ++row) {
    const auto dart = [&](int r, NodeIndex node) { return r * nodes + static_cast<int>(node); };
    for (NodeIndex node = 0; node < rule.left.nodes.size(); ++node)
      for (std::size_t p = 0; p < rule.left.nodes[node].label.size(); ++p) {
        const int i = rule.left.nodes[node].label[p];
        if (i != kBlank &&
            !table.set(i, dart(row, node), dart(rows.get(static_cast<int>(p), row), node)))
          return false;
      }
    for (const PatternArc& arc : rule.left.arcs)
      if (!table.set(arc.dimension, dart(row, arc.a), dart(row, arc.b))) return false;
    for (const check::PatternPath& path : rule.left.paths) {
      int at = dart(row, path.from);
      for (std::size_t k = 0; k < path.dimensions.size(); ++k) {
        const int i = path.dimensions[k];
        const bool last = k + 1 == path.dimensions.size();
        if (table.get(i, at) == kNone && !table.set(i, at, last ? dart(row, path.to) : table.add()))
          return false;
        at = table.get(i, at);
      }
      if (at != dart(row, path.to)) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Host> host_of(const Rule& rule, Random& random) {
  for (int attempt = 0; attempt < 6; ++attempt) {
    const std::optional<PartialTable> rows = random_rows(rule, random);
    PartialTable table = PartialTable::of_map(rule.dimension);
    if (!rows || !instantiate(rule, *rows, table)) continue;
    if (rule.left.nodes.empty()) table.add();
    PartialTable::Style style;
    style.loop = 0.2 * static_cast<double>(below(random, 4));
    style.join = 0.2 * static_cast<double>(below(random, 4));
    style.soft_limit = table.size() + 2 + below(random, 16);
    if (!table.complete(random, style)) continue;
    Host host;
    host.map = table.map(rule.dimension);
    for (const NodeIndex hook : rule.hooks) host.hook_darts.push_back(static_cast<int>(hook));
    return host;
  }
  return std::nullopt;
}

}  // namespace gmsim::tests
