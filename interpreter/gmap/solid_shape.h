// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// The facets of a kind of solid, as local corner numbers in order, the base first. Corners of
/// every facet turn so that its normal points into the solid.
[[nodiscard]] std::span<const std::vector<std::uint8_t>> solid_facets(Mesh::CellKind kind);

/// For each corner the one that takes its place when the solid is mirrored around corner 0.
[[nodiscard]] std::span<const std::uint8_t> mirrored_corners(Mesh::CellKind kind);

/// A solid as a map of its own: for each dart its corner and its links, as local numbers.
struct SolidDarts {
  std::vector<std::uint8_t> corner;
  std::array<std::vector<std::uint8_t>, 3> alpha;
};
[[nodiscard]] SolidDarts solid_darts(Mesh::CellKind kind);

}  // namespace gmsim::gmap
