// SPDX-License-Identifier: MIT
#include "gmap/random_map.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace gmsim::gmap {
namespace {

using Involution = std::vector<std::uint32_t>;

/// A random involution that commutes with `other` (any involution when `other` is the identity):
/// the orbits of `other` are paired at random with one of the same size, or mapped to themselves.
Involution commuting_involution(const Involution& other, std::mt19937_64& random) {
  const auto count = static_cast<std::uint32_t>(other.size());
  Involution result(count);
  std::array<std::vector<std::uint32_t>, 2> orbits;  // a dart of each orbit, by size - 1
  for (std::uint32_t d = 0; d < count; ++d)
    if (other[d] >= d) orbits[other[d] == d ? 0 : 1].push_back(d);
  const std::uint64_t free_percent = random() % 60;
  for (auto& list : orbits) {
    std::shuffle(list.begin(), list.end(), random);
    while (!list.empty()) {
      const std::uint32_t a = list.back();
      list.pop_back();
      std::uint32_t b = a;
      if (!list.empty() && random() % 100 >= free_percent) {
        b = list.back();
        list.pop_back();
      }
      if (random() % 2 == 0) b = other[b];  // with b = a: links a to its partner, or leaves it free
      result[a] = b;
      result[b] = a;
      result[other[a]] = other[b];
      result[other[b]] = other[a];
    }
  }
  return result;
}

}  // namespace

GMap random_map(int dimension, std::uint32_t darts, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Involution identity(darts);
  for (std::uint32_t d = 0; d < darts; ++d) identity[d] = d;
  std::array<Involution, types::kMaxDimension + 1> alpha;
  // Each dimension must commute with those at least two away: 0 and 1 with 3, 2 with 0.
  alpha[3] = dimension == 3 ? commuting_involution(identity, random) : identity;
  alpha[0] = commuting_involution(alpha[3], random);
  alpha[1] = commuting_involution(alpha[3], random);
  alpha[2] = commuting_involution(alpha[0], random);
  GMap map(dimension);
  map.add_darts(darts);
  for (int i = 0; i <= dimension; ++i)
    for (std::uint32_t d = 0; d < darts; ++d) map.set_alpha(i, DartId{d}, DartId{alpha[i][d]});
  return map;
}

}  // namespace gmsim::gmap
