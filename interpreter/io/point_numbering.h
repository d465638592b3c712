// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gmap/orbit_index.h"

namespace gmsim::io {

/// The numbers that the vertices of a map have in output files. A vertex keeps its number while it
/// lives; new vertices get the next ones. Only when vertices die do those behind them move up,
/// their order kept.
class PointNumbering {
 public:
  /// In the order of the index's rows.
  explicit PointNumbering(const gmap::OrbitIndex& vertices);
  /// In the order of a mesh: `point_dart` as in gmap::MeshMap, where unused points are passed over.
  PointNumbering(const gmap::OrbitIndex& vertices, std::span<const gmap::DartId> point_dart);

  /// Follows the index after rewrites.
  void update(const gmap::OrbitIndex& vertices);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::int32_t number(gmap::Row row) const { return numbers_[row]; }
  /// The row of each point.
  [[nodiscard]] std::span<const gmap::Row> rows() const { return rows_; }

 private:
  void append(gmap::Row row);

  std::vector<gmap::Row> rows_;
  std::vector<std::int32_t> numbers_;  // by row; -1: none
};

}  // namespace gmsim::io
