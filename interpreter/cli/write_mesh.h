// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::cli {

/// The number of each vertex in files: that of its mesh point while it lives; vertices made later
/// get new numbers at the end, in order of their oldest dart.
class PointNumbers {
 public:
  PointNumbers() = default;
  PointNumbers(const engine::State& state, const std::vector<std::uint32_t>& dart_point,
               std::size_t point_count);

  /// For each row of the vertex index its point, kNoRow for dead rows; `count` is the number of
  /// points after numbering. Points without a vertex are left out and numbers close up.
  struct Numbering {
    std::vector<std::uint32_t> of_row;
    std::uint32_t count = 0;
  };
  [[nodiscard]] Numbering number(const engine::State& state) const;

 private:
  std::vector<std::uint32_t> point_of_row_;
  std::size_t point_count_ = 0;
};

/// Writes the map with every embedding on vertices and elements to `.vtu` or `.obj`.
void write_mesh(const engine::State& state, const PointNumbers& points,
                const std::filesystem::path& path, support::Diagnostics& diagnostics);

}  // namespace gmsim::cli
