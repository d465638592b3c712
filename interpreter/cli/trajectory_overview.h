// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/trajectory_reader.h"

namespace gmsim::cli {

/// What all frames of a run have between them.
struct TrajectoryOverview {
  struct Range {
    double low = 0, high = 0;
  };
  struct Counts {
    std::int64_t points = 0, cells = 0;
    std::map<io::VtkCell, std::int64_t> kinds;
  };
  struct Field {
    io::FieldDescription description;
    /// Of the values of all frames; of the length, if it is a vector. Empty: no rows.
    std::optional<Range> range;
    std::int64_t not_finite = 0;
  };
  struct Series {
    io::SeriesDescription description;
    std::vector<double> first, last;  ///< one number for each component; empty without reports
  };

  std::vector<Counts> epochs;
  std::array<Range, 3> box;  ///< of all points of all frames (m)
  std::vector<Field> fields;
  std::vector<Series> series;
};

/// Reads the whole file once. Nothing after an error, which is reported as file-error.
[[nodiscard]] std::optional<TrajectoryOverview> read_overview(const io::TrajectoryReader& reader,
                                                              support::Diagnostics& diagnostics);

/// "tetrahedron" for one, else "tetrahedra".
[[nodiscard]] std::string cell_name(io::VtkCell cell, std::int64_t count);

}  // namespace gmsim::cli
