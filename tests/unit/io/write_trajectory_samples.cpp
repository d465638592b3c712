// SPDX-License-Identifier: MIT
// write_trajectory_samples FOLDER: trajectories of synthetic runs, and beside each what its frames
// must read as, in JSON, and a folder of its frames as .vtu. check_trajectories.py compares them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>

#include "io/export_trajectory.h"
#include "io/text_file.h"
#include "support/source_map.h"
#include "unit/io/synthetic_run.h"

using namespace gmsim;
using test::SyntheticRun;

namespace {

constexpr std::int64_t kFrames = 25;

std::string json(const SyntheticRun& run) {
  std::vector<std::string> frames;
  const auto fields = run.description().fields;
  for (std::int64_t i = 0; i < kFrames; ++i) {
    const SyntheticRun::Frame frame = run.frame(i);
    std::vector<std::string> arrays;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      arrays.push_back(fmt::format("\"{}\": {}", fields[k].name, frame.fields[k]));
    }
    std::vector<std::vector<std::int32_t>> cells;
    for (std::size_t cell = 0; cell < frame.mesh.cell_count(); ++cell) {
      const auto corners = frame.mesh.corners(cell);
      cells.emplace_back(corners.begin(), corners.end());
    }
    frames.push_back(
        fmt::format("{{\"time\": {}, \"step\": {}, \"points\": {}, \"cells\": {}, \"fields\": "
                    "{{{}}}, \"darts\": {}, \"events\": {}, \"reports\": {}}}",
                    frame.time, frame.step, frame.points, cells, fmt::join(arrays, ", "),
                    frame.darts, frame.events.size(), frame.reports));
  }
  return fmt::format("[{}]\n", fmt::join(frames, ",\n"));
}

bool write(const std::filesystem::path& folder, const std::string& name,
           SyntheticRun::Options options) {
  const SyntheticRun run(options);
  support::Diagnostics diagnostics;
  const auto writer = io::TrajectoryWriter::create(folder / (name + ".vtkhdf"), run.description(),
                                                   {.force = true}, diagnostics);
  bool ok = writer != nullptr;
  for (std::int64_t i = 0; ok && i < kFrames; ++i) ok = run.write(*writer, i, diagnostics);
  ok = ok && writer->close("", diagnostics) &&
       io::write_file(folder / (name + ".json"), json(run), diagnostics);
  const auto reader =
      ok ? io::TrajectoryReader::open(folder / (name + ".vtkhdf"), diagnostics) : nullptr;
  ok = ok && reader && io::export_trajectory(*reader, folder / name, name, {}, diagnostics);
  support::render(diagnostics, support::SourceMap{}, std::cerr);
  return ok;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  const bool ok =
      write(folder, "sheet", {.seed = 21}) &&
      write(folder, "solid", {.seed = 22, .dimension = 3}) &&
      write(folder, "no_polyhedra_yet", {.seed = 23, .dimension = 2, .polyhedra = true}) &&
      write(folder, "polyhedra", {.seed = 24, .dimension = 3, .polyhedra = true}) &&
      write(folder, "larger", {.seed = 25, .dimension = 3, .points = 400});
  return ok ? 0 : 1;
}
