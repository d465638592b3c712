// SPDX-License-Identifier: MIT
#include "gmap/orbit_index.h"

#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

/// Gives the orbit of d the row `row`. `queue` is work space.
void fill_orbit(const detail::OrbitLinks& links, DartId d, Row row, std::vector<Row>& rows,
                std::vector<DartId>& queue) {
  if (links.count <= 2) {
    return detail::walk_linear(links, d, [&](DartId x) { rows[index(x)] = row; });
  }
  queue.assign(1, d);
  rows[index(d)] = row;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (int k = 0; k < links.count; ++k) {
      const DartId x = links.alpha[k][index(queue[next])];
      if (rows[index(x)] == row) continue;
      rows[index(x)] = row;
      queue.push_back(x);
    }
  }
}

}  // namespace

OrbitIndex::OrbitIndex(const GMap& map, OrbitType type)
    : type_(type), rows_(map.dart_end(), kNoRow) {
  const detail::OrbitLinks links(map, type);
  std::vector<DartId> queue;
  for (std::uint32_t i = 0; i < map.dart_end(); ++i) {
    if (rows_[i] != kNoRow || !map.alive(DartId{i})) continue;
    fill_orbit(links, DartId{i}, row_end(), rows_, queue);
    smallest_.push_back(DartId{i});
  }
  smallest_.shrink_to_fit();
  alive_ = row_end();
}

std::size_t OrbitIndex::memory_bytes() const {
  return sizeof(*this) + rows_.capacity() * sizeof(Row) + smallest_.capacity() * sizeof(DartId);
}

}  // namespace gmsim::gmap
