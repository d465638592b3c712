// SPDX-License-Identifier: MIT
#include "check/known_darts.h"

#include <algorithm>
#include <cstdlib>

namespace gmsim::check {

KnownDarts::KnownDarts(const Pattern& pattern, int dimension) : dimension_(dimension) {
  darts_.resize(pattern.nodes.size());
  for (const PatternArc& arc : pattern.arcs) link(arc.a, arc.b, arc.dimension);
  for (const PatternPath& path : pattern.paths) {
    Id at = path.from;
    for (std::size_t k = 0; k + 1 < path.dimensions.size(); ++k) at = walk(at, path.dimensions[k]);
    link(at, path.to, path.dimensions.back());
  }
}

KnownDarts::Id KnownDarts::add() {
  darts_.emplace_back();
  return darts_.size() - 1;
}

void KnownDarts::link(Id a, Id b, int i) {
  const auto dimension = static_cast<std::size_t>(i);
  // A pattern that contradicts itself is reported elsewhere; the first link stays here.
  if (darts_[a][dimension] || darts_[b][dimension]) return;
  darts_[a][dimension] = b;
  darts_[b][dimension] = a;
}

/// With i and j commuting: if dart -j- y -i- z -j- w is known, w is the dart over link i.
std::optional<KnownDarts::Id> KnownDarts::across_square(Id dart, int i) const {
  for (int j = 0; j <= dimension_; ++j) {
    if (std::abs(i - j) < 2) continue;
    const auto ji = static_cast<std::size_t>(j), ii = static_cast<std::size_t>(i);
    const auto y = darts_[dart][ji];
    const auto z = y ? darts_[*y][ii] : std::nullopt;
    if (z && darts_[*z][ji]) return darts_[*z][ji];
  }
  return std::nullopt;
}

KnownDarts::Id KnownDarts::walk(Id dart, int i) {
  const auto ii = static_cast<std::size_t>(i);
  if (const auto known = darts_[dart][ii]) return *known;
  const auto square = across_square(dart, i);
  const Id next = square && !darts_[*square][ii] ? *square : add();
  link(dart, next, i);
  // Close the squares that now have three known sides.
  for (int j = 0; j <= dimension_; ++j) {
    if (std::abs(i - j) < 2) continue;
    const auto y = darts_[dart][static_cast<std::size_t>(j)];
    const auto z = y ? darts_[*y][ii] : std::nullopt;
    if (z) link(next, *z, j);
  }
  return next;
}

std::set<KnownDarts::Id> KnownDarts::orbit(Id dart, OrbitType type) const {
  std::set<Id> reached = {dart};
  std::vector<Id> open = {dart};
  while (!open.empty()) {
    const Id at = open.back();
    open.pop_back();
    for (int i = 0; i <= dimension_; ++i)
      if (const auto next = darts_[at][static_cast<std::size_t>(i)];
          next && type.contains(i) && reached.insert(*next).second)
        open.push_back(*next);
  }
  return reached;
}

bool KnownDarts::orbit_is_known(Id dart, OrbitType type) const {
  const std::set<Id> darts = orbit(dart, type);
  return std::ranges::all_of(darts, [&](Id at) {
    for (int i = 0; i <= dimension_; ++i)
      if (type.contains(i) && !darts_[at][static_cast<std::size_t>(i)]) return false;
    return true;
  });
}

bool KnownDarts::same_vertex(Id a, Id b) const { return orbit(a, vertex()).contains(b); }

}  // namespace gmsim::check
