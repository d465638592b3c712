// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "gmap/orbit_index.h"

namespace gmsim::engine {

/// Vertices begin … end-1.
struct RowRange {
  gmap::Row begin = 0, end = 0;
};

/// Some neighbouring matches of one table, evaluated as a whole.
struct ForcePiece {
  std::uint32_t block = 0;
  std::uint32_t begin = 0, end = 0;  ///< matches
  std::uint32_t slots = 0;           ///< places for forces that it needs
  RowRange pushed;                   ///< holds all vertices that it pushes
  // Of the plan:
  std::uint32_t first_slot = 0;
  RowRange complete;                 ///< whose forces are all known once it has run
};

/// Pieces that run one after another.
struct ForceChunk {
  std::uint32_t begin = 0, end = 0;  ///< pieces
};

/// In which order to evaluate, and when to sum. Pieces follow each other along the vertices, and a
/// vertex is summed as soon as all its forces are there, so that they are still in the cache; then
/// their slots are used again. Chunks share no slots: each can be given to a thread. Nothing of this
/// changes the order in which the forces on a vertex are added.
struct ForceSchedule {
  std::vector<ForcePiece> pieces;
  std::vector<ForceChunk> chunks;
  std::vector<RowRange> last;  ///< vertices that are summed when all chunks have run
  std::uint32_t slots = 0;
};

/// `chunks`: at most so many. `keep`: no slot is used twice, so that all forces are there at the end.
[[nodiscard]] ForceSchedule plan_schedule(std::vector<ForcePiece> pieces, gmap::Row vertices,
                                          std::uint32_t chunks, bool keep);

}  // namespace gmsim::engine
