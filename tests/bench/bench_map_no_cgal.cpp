// SPDX-License-Identifier: MIT
#include "bench/bench_map_cgal.h"

namespace gmsim::bench {

CgalTimes measure_cgal(const gmap::Mesh&, int) {
  return {};
}

}  // namespace gmsim::bench
