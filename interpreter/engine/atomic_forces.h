// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compile/specialise.h"
#include "engine/force_field.h"
#include "engine/row_lists.h"
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
  // Its place in the canonical order.
  std::uint32_t number = 0;           ///< of the interaction, as the model counts
  DartId key = gmap::kNoDart;         ///< of the match
  std::uint32_t target = 0;           ///< of the match's darts
};

/// What a force field's last refresh() did to its list of atomic forces.
struct AtomicForceChanges {
  /// A match whose forces left the list, on one of its darts.
  struct Gone {
    DartId dart = gmap::kNoDart;
    std::uint32_t number = 0;
    DartId key = gmap::kNoDart;
  };
  std::vector<Gone> gone;         ///< each dart of a match at least once
  std::vector<AtomicForce> come;  ///< after what is gone, some of which may be back with another slot
};

/// All internal atomic forces: what force_on() and forces() read. Loads (`external`) are not among
/// them.
class AtomicForceIndex final : public compile::AtomicForceList {
 public:
  explicit AtomicForceIndex(const gmap::GMap& map) : map_(map) {}

  /// `forces` in the canonical order: interaction, match, force line.
  void rebuild(std::span<const AtomicForce> forces);
  /// Follows a change; numbers of forces that are still there stay. Appends the darts whose lists are
  /// others now.
  void update(const AtomicForceChanges& changes, std::vector<DartId>& changed);
  /// Numbers of the forces that live on sub-orbits of the orbit of `dart`: by ascending dart, those of
  /// one dart in the canonical order.
  void list(types::OrbitType orbit, DartId dart, std::vector<std::uint32_t>& out) const override;

  [[nodiscard]] const AtomicForce& operator[](std::uint32_t number) const { return forces_[number]; }
  /// The values of all of them (N), by number.
  void read(std::span<const VertexRecord> slots, std::vector<VertexRecord>& values) const;

 private:
  void leave(const AtomicForceChanges::Gone& gone);
  /// True when it was there, waiting to be dropped.
  bool come_back(const AtomicForce& force);
  void insert(const AtomicForce& force);

  const gmap::GMap& map_;
  std::vector<AtomicForce> forces_;        // by number; what nobody lists has no share
  std::vector<std::uint32_t> free_;        // numbers
  RowLists<std::uint32_t> lists_;          // by dart: numbers in canonical order
  std::vector<std::pair<DartId, std::uint32_t>> leaving_;  // of an update: darts and numbers
  mutable std::vector<DartId> darts_;      // work space
};

/// The same forces as expressions ask for them one orbit at a time: conditions of a scene, output
/// fields.
struct AtomicForceReader {
  const AtomicForceIndex* index = nullptr;
  std::span<const VertexRecord> slots;  ///< as ForceField::atomic_slots()

  /// The sum over an orbit; `only` as in OrbitForces.
  [[nodiscard]] VertexRecord sum(types::OrbitType orbit, DartId dart, std::uint32_t only) const;
  /// One by one, in the order of AtomicForceIndex::list().
  [[nodiscard]] std::vector<VertexRecord> list(types::OrbitType orbit, DartId dart) const;
};

/// force_on(O(a)) for all orbits of a type, of all interactions or of one.
class OrbitForces {
 public:
  /// `only`: 0 for all interactions, else 1 + the number of one.
  OrbitForces(types::OrbitType orbit, std::uint32_t only) : orbit_(orbit), only_(only) {}

  void rebuild(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits);
  /// Follows changes of the lists and links of these darts; `removed`: rows that are gone.
  void update(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits,
              std::span<const DartId> darts, std::span<const gmap::Row> removed);
  void sum(std::span<const VertexRecord> slots);
  /// By row of the orbit index (N).
  [[nodiscard]] std::span<const VertexRecord> values() const { return values_; }
  [[nodiscard]] types::OrbitType orbit() const { return orbit_; }
  [[nodiscard]] std::uint32_t only() const { return only_; }

 private:
  void list(const AtomicForceIndex& atomic, DartId dart);

  types::OrbitType orbit_;
  std::uint32_t only_;
  RowLists<SlotShare> terms_;
  std::vector<VertexRecord> values_;
  std::vector<std::uint32_t> numbers_;  // work space
  std::vector<SlotShare> listed_;
};

}  // namespace gmsim::engine
