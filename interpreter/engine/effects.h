// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state.h"
#include "gmap/orbit_index.h"

namespace gmsim::engine {

/// How the orbits of one indexed type changed.
struct OrbitEvents {
  OrbitType type;
  gmap::OrbitRepair repair;
};

/// An orbit that was given a value.
struct WrittenOrbit {
  OrbitType type;
  DartId dart = gmap::kNoDart;
};

/// What one or several rewrites changed and what it cost: counters for `--profile`.
struct Effects {
  std::vector<DartId> touched;       ///< darts with a changed link, created and removed ones too
  OrbitType changed_links;           ///< dimensions in which links of preserved darts may have changed
  std::vector<WrittenOrbit> written; ///< where a rule assigned a value
  std::vector<OrbitEvents> orbits;   ///< one entry for each orbit type in use that was repaired
  std::uint64_t applications = 0;    ///< rules applied
  std::uint64_t dropped = 0;         ///< candidates that did not match when their turn came
  std::uint64_t created_darts = 0;
  std::uint64_t removed_darts = 0;
  std::uint64_t matched_rows = 0;    ///< rows of the match tables of what was applied
  std::uint64_t written_values = 0;  ///< embedding values stored

  gmap::OrbitRepair& repair(OrbitType type);
  /// Null when no orbit of this type was repaired.
  [[nodiscard]] const gmap::OrbitRepair* find(OrbitType type) const;
  /// Darts that the repairs of orbit indices walked.
  [[nodiscard]] std::uint64_t visited_darts() const;
  /// Adds what happened after this.
  void append(const Effects& later);
  /// Did nothing happen? An operation may assign values without applying a rule.
  [[nodiscard]] bool nothing() const { return applications == 0 && written.empty(); }
  /// Nothing happened; keeps its memory.
  void clear();
};

}  // namespace gmsim::engine
