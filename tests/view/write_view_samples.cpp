// SPDX-License-Identifier: MIT
// write_view_samples FOLDER: trajectories of bodies that tear, and their pages. check_pages.py looks
// at them in a browser.
#include <filesystem>
#include <iostream>
#include <utility>

#include "io/html_view.h"
#include "io/text_file.h"
#include "io/trajectory_writer.h"
#include "support/source_map.h"
#include "view/torn_bodies.h"

using namespace gmsim;

namespace {

io::RunDescription description() {
  io::RunDescription run;
  run.rule_names = {"separate"};
  run.criterion_names = {"stretched"};
  run.fields = {
      {"velocity", 3, io::FieldPlace::Point, io::NumberType::Float64, "velocity", "<1,2>", "m/s"},
      {"side", 1, io::FieldPlace::Cell, io::NumberType::Float64, "", "<0,1>", ""}};
  return run;
}

bool write_run(const std::filesystem::path& path, test::TornFrame (*make)(std::int64_t),
               support::Diagnostics& diagnostics) {
  const auto writer =
      io::TrajectoryWriter::create(path, description(), {.force = true}, diagnostics);
  io::MeshTopology mesh;
  std::size_t tears = 0;
  for (std::int64_t i = 0; writer && i < test::kTornFrames; ++i) {
    const test::TornFrame frame = make(i);
    const std::array<io::FrameField, 2> fields = {
        {{.values = std::span(frame.speed)}, {.values = std::span(frame.side)}}};
    const std::vector<io::TearEvent> events(frame.tears - std::exchange(tears, frame.tears));
    io::FrameData data{.time = 0.05 * static_cast<double>(i),
                       .step = 50 * i,
                       .points = frame.points,
                       .topology = {},
                       .fields = fields,
                       .events = events};
    if (i == 0 || frame.mesh != mesh) data.topology = io::NewTopology{&frame.mesh, 0, {}};
    if (!writer->write_frame(data, diagnostics)) return false;
    mesh = frame.mesh;
  }
  return writer && writer->close("", diagnostics);
}

bool write_sample(const std::filesystem::path& folder, const std::string& name,
                  test::TornFrame (*make)(std::int64_t), support::Diagnostics& diagnostics) {
  const auto path = folder / (name + ".vtkhdf");
  if (!write_run(path, make, diagnostics)) return false;
  const auto reader = io::TrajectoryReader::open(path, diagnostics);
  if (!reader) return false;
  const auto view = io::html_view(*reader, {.title = name}, diagnostics);
  return view && io::write_file(folder / (name + ".html"), view->text, diagnostics);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  support::Diagnostics diagnostics;
  const bool ok = write_sample(folder, "sheet", test::torn_sheet, diagnostics) &&
                  write_sample(folder, "block", test::torn_block, diagnostics) &&
                  write_sample(folder, "chain", test::torn_chain, diagnostics);
  support::render(diagnostics, support::SourceMap{}, std::cerr);
  return ok ? 0 : 1;
}
