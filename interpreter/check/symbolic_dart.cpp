// SPDX-License-Identifier: MIT
#include "check/symbolic_dart.h"

#include <map>
#include <tuple>

namespace gmsim::check {
namespace {

/// More darts than this are not compared; two darts of one orbit may then look different.
constexpr std::size_t kMostDarts = 256;

/// How far out a dart is named: fewer unknown links, then nearer rows.
auto distance(const SymbolicDart& dart) {
  return std::pair(dart.walk.size(), dart.rows.size());
}

bool simpler(const SymbolicDart& a, const SymbolicDart& b) {
  return std::tuple(distance(a), a) < std::tuple(distance(b), b);
}

}  // namespace

SymbolicDart DartAlgebra::walk(SymbolicDart dart, int dimension) const {
  dart.walk = walks_.product(dart.walk, {static_cast<std::uint8_t>(dimension)});
  while (absorb(dart)) {
  }
  return dart;
}

/// Takes one link that is known off the walk: any that can come first by commuting.
bool DartAlgebra::absorb(SymbolicDart& dart) const {
  if (!dart.of_match) return false;
  for (std::size_t at = 0; at < dart.walk.size(); ++at) {
    bool first = true;
    for (std::size_t k = 0; k < at; ++k) first &= walks_.commute(dart.walk[k], dart.walk[at]);
    const std::optional<LinkTarget>& link = links_.link(dart.base, dart.walk[at]);
    if (!first || !link) continue;
    dart.base = link->node;
    dart.rows = links_.rows().product(dart.rows, link->rows);
    dart.walk.erase(dart.walk.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
  }
  return false;
}

SymbolicDart DartAlgebra::from_next_row(SymbolicDart dart, std::uint8_t position) const {
  if (dart.of_match) dart.rows = links_.rows().product({position}, dart.rows);
  return dart;
}

/// The simplest dart of an orbit among those that walks which never lead further out reach, and
/// whether the walk to it is odd.
std::pair<SymbolicDart, bool> DartAlgebra::least(const SymbolicDart& dart,
                                                 types::OrbitType type) const {
  std::map<SymbolicDart, bool> seen{{dart, false}};
  std::vector<SymbolicDart> todo{dart};
  SymbolicDart best = dart;
  while (!todo.empty() && seen.size() < kMostDarts) {
    const SymbolicDart at = todo.back();
    todo.pop_back();
    for (int i = 0; i <= links_.dimension(); ++i) {
      if (!type.contains(i)) continue;
      SymbolicDart next = walk(at, i);
      if (distance(next) > distance(at) || !seen.emplace(next, !seen[at]).second) continue;
      if (simpler(next, best)) best = next;
      todo.push_back(std::move(next));
    }
  }
  return {best, seen[best]};
}

SymbolicDart DartAlgebra::representative(const SymbolicDart& dart, types::OrbitType type) const {
  return least(dart, type).first;
}

std::pair<SymbolicDart, bool> DartAlgebra::around_face(const SymbolicDart& dart) const {
  return least(dart, types::OrbitType{0, 1});
}

}  // namespace gmsim::check
