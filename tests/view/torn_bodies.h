// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh_frame.h"

namespace gmsim::test {

/// A frame of a body that is torn in the course of kTornFrames frames: points move by a formula.
struct TornFrame {
  std::vector<std::array<double, 3>> points;
  io::MeshTopology mesh;
  std::vector<double> speed;  ///< by point, three components (m/s)
  std::vector<double> side;   ///< by cell: 0 or 1
  std::size_t tears = 0;      ///< points that were split so far
};
inline constexpr std::int64_t kTornFrames = 61;

/// A waving sheet of squares, split along its middle from below.
[[nodiscard]] TornFrame torn_sheet(std::int64_t frame);
/// A block of hexahedra that opens in the middle from above.
[[nodiscard]] TornFrame torn_block(std::int64_t frame);
/// A swinging chain with a ball at the end; its middle link parts.
[[nodiscard]] TornFrame torn_chain(std::int64_t frame);

}  // namespace gmsim::test
