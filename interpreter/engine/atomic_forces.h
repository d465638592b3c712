// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "gmap/gmap.h"
#include "types/expr.h"

namespace gmsim::engine {

/// The force of one match on one particle, where the rule says that it lives: `force X on ORBIT`.
struct AtomicForce {
  gmap::DartId dart = gmap::kNoDart;  ///< X
  types::OrbitType orbit;             ///< ORBIT
  types::InteractionId interaction{};
  std::array<double, 3> force{};      ///< N
};

/// All internal atomic forces at one moment: what force_on() and forces() of criteria and fields
/// read. Loads (`external`) are left out. When several darts that a match names lie in one vertex,
/// they share the force on it equally.
class AtomicForces {
 public:
  using Force = std::array<double, 3>;

  /// Takes over new forces, in the canonical order (interaction, match, force line).
  void assign(std::span<const AtomicForce> forces, std::size_t dart_capacity);

  /// Sum of the forces that live on sub-orbits of the orbit of `dart`, of all interactions or of
  /// one; summed by ascending dart.
  [[nodiscard]] Force force_on(const gmap::GMap& map, types::OrbitType orbit, gmap::DartId dart,
                               std::optional<types::InteractionId> only = std::nullopt) const;
  /// Calls visit(force) for each of them, in the same order, until it returns false.
  void for_each(const gmap::GMap& map, types::OrbitType orbit, gmap::DartId dart,
                const std::function<bool(const AtomicForce&)>& visit) const;

 private:
  std::vector<AtomicForce> forces_;   // by dart
  std::vector<std::uint32_t> first_;  // by dart: where its forces begin
};

}  // namespace gmsim::engine
