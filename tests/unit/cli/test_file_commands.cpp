// SPDX-License-Identifier: MIT
// info, export, recover and snapshot on files of a synthetic run.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "io/trajectory_reader.h"
#include "io/trajectory_writer.h"
#include "unit/cli/command.h"
#include "unit/io/synthetic_run.h"

using namespace gmsim;
using test::Command;
using test::has;
using test::run_command;

namespace {

constexpr std::int64_t kFrames = 7;

/// A finished run, or the `.part` of one that was cut short.
std::string write_run(const test::TestFolder& folder, bool finished) {
  const test::SyntheticRun run({.seed = 5, .dimension = 3, .polyhedra = true});
  support::Diagnostics diagnostics;
  const std::string path = folder.file("run.vtkhdf");
  const auto writer = io::TrajectoryWriter::create(path, run.description(), {}, diagnostics);
  REQUIRE(writer);
  for (std::int64_t i = 0; i < kFrames; ++i) REQUIRE(run.write(*writer, i, diagnostics));
  if (finished) REQUIRE(writer->close("0123abcd", diagnostics));
  return finished ? path : path + ".part";
}

}  // namespace

TEST_CASE("info names frames, meshes, fields with units, series and origin") {
  const test::TestFolder folder;
  const Command info = run_command({"info", write_run(folder, true)});
  CAPTURE(info.out);
  CHECK(info.exit_code == 0);
  CHECK(info.err.empty());
  for (const char* part :
       {"run        complete", "frames     7, from 0 s", "3D, ", "velocity        point  length",
        " m/s", "corner_force    orbit", "momentum", "gmsim scene.yaml --set integrator.dt=1e-3",
        "0123abcd", "2 rule files"})
    CHECK_MESSAGE(has(info.out, part), part);
}

TEST_CASE("info --json is one JSON object that agrees with the file") {
  const test::TestFolder folder;
  const std::string path = write_run(folder, true);
  const Command info = run_command({"info", path, "--json"});
  CHECK(info.exit_code == 0);
  CHECK(std::count(info.out.begin(), info.out.end(), '\n') == 1);
  const YAML::Node json = YAML::Load(info.out);  // JSON is YAML
  support::Diagnostics diagnostics;
  const auto reader = io::TrajectoryReader::open(path, diagnostics);
  REQUIRE(reader);
  CHECK(json["frames"].as<int>() == kFrames);
  CHECK(json["complete"].as<bool>());
  CHECK(json["times"].as<std::vector<double>>() ==
        std::vector(reader->times().begin(), reader->times().end()));
  CHECK(json["meshes"].size() == static_cast<std::size_t>(reader->summary().epochs));
  CHECK(json["fields"].size() == reader->run().fields.size());
  CHECK(json["command"].as<std::string>() == reader->run().command);
}

TEST_CASE("the range of a field is that of all frames") {
  const test::TestFolder folder;
  const std::string path = write_run(folder, true);
  support::Diagnostics diagnostics;
  const auto reader = io::TrajectoryReader::open(path, diagnostics);
  REQUIRE(reader);
  const YAML::Node json = YAML::Load(run_command({"info", path, "--json"}).out);
  for (std::size_t i = 0; i < reader->run().fields.size(); ++i) {
    const auto& field = reader->run().fields[i];
    if (field.place == io::FieldPlace::Orbit || field.components == 3) continue;
    double low = INFINITY, high = -INFINITY;
    for (std::int64_t frame = 0; frame < kFrames; ++frame) {
      const auto array = reader->read_field(i, frame, diagnostics);
      for (const double value : array->values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    CAPTURE(field.name);
    CHECK(json["fields"][i]["low"].as<double>() == low);
    CHECK(json["fields"][i]["high"].as<double>() == high);
  }
}

TEST_CASE("the scene and the rules come out as they went in") {
  const test::TestFolder folder;
  const std::string path = write_run(folder, true);
  CHECK(run_command({"info", path, "--scene"}).out == "dimension: 2  # größer\nbodies: []\n");
  CHECK(has(run_command({"info", path, "--rules"}).out,
            "// ---- springs (stdlib-rules/springs.rule)\n"
            "interaction stretch_spring on <0>(a) {}\n"));
}

TEST_CASE("what a run that was cut short left can be looked at, recovered and exported") {
  const test::TestFolder folder;
  const std::string part = write_run(folder, false);
  CHECK(has(run_command({"info", part}).out, "going on, or cut short"));
  const Command recovered = run_command({"recover", part});
  CAPTURE(recovered.err);
  CHECK(recovered.exit_code == 0);
  CHECK(has(recovered.out, "7 frames"));
  CHECK(has(run_command({"info", folder.file("run.vtkhdf")}).out, "recovered from a run"));

  const Command again = run_command({"recover", part});
  CHECK(again.exit_code == 3);
  CHECK(has(again.err, "is there already"));
  CHECK(run_command({"recover", part, "--force"}).exit_code == 0);
  CHECK(run_command({"snapshot", part, "-o", folder.file("now.vtkhdf")}).exit_code == 0);

  const std::string frames = folder.file("frames");
  CHECK(run_command({"export", part, "-o", frames}).exit_code == 0);
  CHECK(run_command({"export", part, "-o", frames, "--format", "obj", "--every", "3"}).exit_code == 0);
  CHECK(run_command({"export", part, "-o", frames, "--format", "usd"}).exit_code == 0);
  for (const char* name : {"frames/run.pvd", "frames/run_0006.vtu", "frames/run_0003.obj",
                           "frames/run.usda"})
    CHECK_MESSAGE(folder.has(name), name);
  CHECK_FALSE(folder.has("frames/run_0004.obj"));
}
