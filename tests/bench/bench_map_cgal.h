// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "gmap/mesh.h"

namespace gmsim::bench {

/// What CGAL's Generalized_map takes for the jobs of bench_map, in the same order.
struct CgalTimes {
  bool measured = false;  ///< false: built without CGAL
  std::array<double, 7> ns_per_dart{};
  double bytes_per_dart = 0.0;
};

[[nodiscard]] CgalTimes measure_cgal(const gmap::Mesh& mesh, int repetitions);

}  // namespace gmsim::bench
