// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/trajectory_reader.h"
#include "io/trajectory_writer.h"

namespace gmsim::test {

/// A run whose every number follows from a seed, so that any frame can be made again to compare:
/// meshes that change at random frames, fields of every place and type, events and reports.
class SyntheticRun {
 public:
  struct Options {
    std::uint32_t seed = 1;
    int dimension = 2;       ///< 2: polygons; 3: solids
    bool polyhedra = false;  ///< dimension 3: some cells are polyhedra
    std::size_t points = 12;
  };
  struct Frame {
    double time = 0;
    std::int64_t step = 0;
    std::int64_t epoch = 0;
    bool begins_epoch = false;
    std::vector<std::array<double, 3>> points;
    io::MeshTopology mesh;
    std::vector<std::int32_t> changes;
    std::vector<std::vector<double>> fields;  ///< by field of the description
    std::vector<std::int32_t> darts;          ///< of the field on orbits
    std::vector<io::TearEvent> events;
    std::vector<std::vector<double>> reports;  ///< since the frame before
  };

  explicit SyntheticRun(Options options) : options_(options) {}

  [[nodiscard]] io::RunDescription description() const;
  [[nodiscard]] Frame frame(std::int64_t number) const;
  /// Writes one frame, as an engine would: fields that did not change are not given again.
  bool write(io::TrajectoryWriter& writer, std::int64_t number,
             support::Diagnostics& diagnostics) const;
  /// What differs between a file's first `frames` frames and this run; empty when nothing does.
  [[nodiscard]] std::string difference(const io::TrajectoryReader& reader,
                                       std::int64_t frames) const;
  /// The same for one frame.
  [[nodiscard]] std::string frame_difference(const io::TrajectoryReader& reader,
                                             std::int64_t number) const;

 private:
  [[nodiscard]] bool begins_epoch(std::int64_t frame) const;
  [[nodiscard]] std::int64_t first_frame_of_epoch(std::int64_t frame) const;
  [[nodiscard]] io::MeshTopology mesh(std::int64_t epoch_frame, std::size_t points) const;

  Options options_;
};

}  // namespace gmsim::test
