// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// A facet of a cell while cells are put together: its darts are consecutive.
struct CellFacet {
  DartId first;
  std::uint32_t darts;
};

/// Sews every two facets that have the same points, in the dimension of the map. `built` has its
/// darts, dart_point and dart_cell; what does not fit goes to its problems, and then not everything
/// is sewn.
void sew_facets(MeshMap& built, std::span<const CellFacet> facets);

}  // namespace gmsim::gmap
