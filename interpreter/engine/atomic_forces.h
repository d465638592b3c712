// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/specialise.h"
#include "engine/force_field.h"
#include "gmap/gmap.h"
#include "gmap/orbit_index.h"
#include "types/expr.h"

namespace gmsim::engine {

/// The force of one match on one particle, where the rule says that it lives: `force X on ORBIT`.
/// When several darts that a match names lie in one vertex, they share the force on it equally.
struct AtomicForce {
  DartId dart = gmap::kNoDart;        ///< X
  types::OrbitType orbit;             ///< ORBIT
  types::InteractionId interaction{};
  std::uint32_t slot = 0;             ///< of the force on the vertex, among those of the force field
  double share = 1;                   ///< of what stands there; negative where that is the opposite
};

/// All internal atomic forces: what force_on() and forces() read. Loads (`external`) are not among
/// them.
class AtomicForceIndex final : public compile::AtomicForceList {
 public:
  explicit AtomicForceIndex(const gmap::GMap& map) : map_(map) {}

  /// `forces` in the canonical order: interaction, match, force line.
  void rebuild(std::span<const AtomicForce> forces);
  /// Numbers of the forces that live on sub-orbits of the orbit of `dart`: by ascending dart, those of
  /// one dart in the canonical order.
  void list(types::OrbitType orbit, DartId dart, std::vector<std::uint32_t>& out) const override;

  [[nodiscard]] const AtomicForce& operator[](std::uint32_t number) const { return forces_[number]; }
  /// The values of all of them (N), by number.
  void read(std::span<const VertexRecord> slots, std::vector<VertexRecord>& values) const;

 private:
  const gmap::GMap& map_;
  std::vector<AtomicForce> forces_;   // by dart
  std::vector<std::uint32_t> first_;  // by dart: where its forces begin
};

/// force_on(O(a)) for all orbits of a type, of all interactions or of one.
class OrbitForces {
 public:
  /// `only`: 0 for all interactions, else 1 + the number of one.
  OrbitForces(types::OrbitType orbit, std::uint32_t only) : orbit_(orbit), only_(only) {}

  void rebuild(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits);
  void sum(std::span<const VertexRecord> slots);
  /// By row of the orbit index (N).
  [[nodiscard]] std::span<const VertexRecord> values() const { return values_; }
  [[nodiscard]] types::OrbitType orbit() const { return orbit_; }
  [[nodiscard]] std::uint32_t only() const { return only_; }

 private:
  struct Term {
    std::uint32_t slot = 0;
    double share = 1;
  };
  types::OrbitType orbit_;
  std::uint32_t only_;
  std::vector<Term> terms_;
  std::vector<std::uint32_t> first_;  // by row
  std::vector<VertexRecord> values_;
};

}  // namespace gmsim::engine
