// SPDX-License-Identifier: MIT
#include "io/point_numbering.h"

#include <algorithm>

namespace gmsim::io {

PointNumbering::PointNumbering(const gmap::OrbitIndex& vertices) {
  update(vertices);
}

PointNumbering::PointNumbering(const gmap::OrbitIndex& vertices,
                               std::span<const gmap::DartId> point_dart) {
  numbers_.assign(vertices.row_end(), -1);
  for (gmap::DartId dart : point_dart) {
    if (dart == gmap::kNoDart) continue;
    const gmap::Row row = vertices.row(dart);
    if (numbers_[row] < 0) append(row);
  }
  update(vertices);
}

void PointNumbering::update(const gmap::OrbitIndex& vertices) {
  const auto dead = [&](gmap::Row row) { return !vertices.alive(row); };
  for (gmap::Row row : rows_) {
    if (dead(row)) numbers_[row] = -1;
  }
  const auto removed = std::erase_if(rows_, dead);
  if (removed > 0) {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      numbers_[rows_[i]] = static_cast<std::int32_t>(i);
  }
  numbers_.resize(vertices.row_end(), -1);
  for (gmap::Row row = 0; row < vertices.row_end(); ++row) {
    if (vertices.alive(row) && numbers_[row] < 0) append(row);
  }
}

void PointNumbering::append(gmap::Row row) {
  numbers_[row] = static_cast<std::int32_t>(rows_.size());
  rows_.push_back(row);
}

}  // namespace gmsim::io
