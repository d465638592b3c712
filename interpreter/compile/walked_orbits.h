// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compile/dependence.h"
#include "gmap/gmap.h"

namespace gmsim::compile {

using types::DartId;
using types::OrbitType;

/// The orbits that are walked while one match is looked at, each of them once however often an
/// expression asks for it, and the darts on whose links the match depends.
class WalkedOrbits {
 public:
  explicit WalkedOrbits(const gmap::GMap& map) : map_(map) {}

  /// Begins a match that depends on these darts.
  void start(std::span<const DartId> darts);
  /// The match depends on the links of this dart.
  void add(DartId dart) { smallest(OrbitType{}, dart); }
  /// The smallest dart of an orbit; the match depends on the links of all its darts.
  DartId smallest(OrbitType type, DartId dart);
  /// One dart for each `inner` orbit that the `outer` orbit of `dart` meets, as gmap::quotient.
  [[nodiscard]] std::vector<DartId> quotient(OrbitType outer, OrbitType inner, DartId dart);

  /// What the match depends on; darts may come twice.
  void swap(std::vector<Dependence>& out) { out.swap(darts_); }

 private:
  struct Slot {
    std::uint32_t epoch = 0;  // that of the match in which the slot was filled
    std::uint32_t type = 0;
    DartId dart{};
    DartId smallest{};
  };
  /// The slot of a dart in an orbit of a type, or the free one where it belongs.
  Slot& find(std::uint32_t type, DartId dart);
  void grow();

  const gmap::GMap& map_;
  std::vector<Dependence> darts_;
  std::vector<DartId> orbit_;  // being walked
  std::vector<Slot> slots_ = std::vector<Slot>(256);  // a power of two, at most half of them in use
  std::size_t used_ = 0;
  std::uint32_t epoch_ = 1;
};

}  // namespace gmsim::compile
