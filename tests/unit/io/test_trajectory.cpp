// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/export_trajectory.h"
#include "io/recover.h"
#include "io/sha256.h"
#include "unit/io/synthetic_run.h"

using namespace gmsim;
using io::TrajectoryReader;
using io::TrajectoryWriter;
using support::Diagnostics;
using test::SyntheticRun;

namespace {

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("gmsim-trajectory-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

std::string message_of(const Diagnostics& diagnostics) {
  return diagnostics.all().empty() ? "" : diagnostics.all().front().message;
}

void write_run(const SyntheticRun& run, const std::filesystem::path& path, std::int64_t frames) {
  Diagnostics diagnostics;
  const auto writer = TrajectoryWriter::create(path, run.description(), {}, diagnostics);
  REQUIRE(writer);
  for (std::int64_t i = 0; i < frames; ++i) {
    const bool written = run.write(*writer, i, diagnostics);
    REQUIRE_MESSAGE(written, message_of(diagnostics));
  }
  CHECK(writer->frames() == frames);
  REQUIRE(writer->close("cafe", diagnostics));
  CHECK(diagnostics.all().empty());
}

}  // namespace

TEST_CASE("every number of a run reads back, in any order of frames") {
  const Folder folder;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    const SyntheticRun run(
        {.seed = seed, .dimension = seed % 2 == 0 ? 3 : 2, .polyhedra = seed % 4 == 0});
    const auto path = folder.path / "run.vtkhdf";
    write_run(run, path, 40);
    CHECK_FALSE(std::filesystem::exists(io::part_path(path)));
    Diagnostics diagnostics;
    const auto reader = TrajectoryReader::open(path, diagnostics);
    REQUIRE(reader);
    CHECK(reader->summary().complete);
    CHECK(reader->summary().state_hash == "cafe");
    CHECK(reader->summary().ending == "finished");
    CHECK(run.difference(*reader, 40) == "");
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i)
      CHECK(run.frame_difference(*reader, static_cast<std::int64_t>(random() % 40)) == "");
    for (std::int64_t i = 40; i-- > 0;) CHECK(run.frame_difference(*reader, i) == "");
  }
}

TEST_CASE("a file says where it comes from") {
  const Folder folder;
  const SyntheticRun run({.seed = 9});
  write_run(run, folder.path / "run.vtkhdf", 3);
  Diagnostics diagnostics;
  const auto reader = TrajectoryReader::open(folder.path / "run.vtkhdf", diagnostics);
  REQUIRE(reader);
  const io::RunDescription expected = run.description();
  const io::RunDescription& stored = reader->run();
  CHECK(stored.dimension == expected.dimension);
  CHECK(stored.scene == expected.scene);
  CHECK(stored.command == expected.command);
  CHECK(stored.started == expected.started);
  CHECK(stored.commit == expected.commit);
  CHECK(stored.program_version == expected.program_version);
  CHECK(stored.seed == expected.seed);
  CHECK(stored.alpha == expected.alpha);
  CHECK(stored.rule_names == expected.rule_names);
  CHECK(stored.criterion_names == expected.criterion_names);
  REQUIRE(stored.rules.size() == 2);
  CHECK(stored.rules[0].module == "springs");
  CHECK(stored.rules[0].path == "stdlib-rules/springs.rule");
  CHECK(stored.rules[0].text == expected.rules[0].text);
  for (const auto& field : expected.fields) {
    const auto found = std::find_if(stored.fields.begin(), stored.fields.end(),
                                    [&](const auto& other) { return other.name == field.name; });
    REQUIRE(found != stored.fields.end());
    CHECK(found->components == field.components);
    CHECK(found->place == field.place);
    CHECK(found->type == field.type);
    CHECK(found->expression == field.expression);
    CHECK(found->orbit == field.orbit);
    CHECK(found->unit == field.unit);
  }
  const auto momentum = std::find_if(stored.series.begin(), stored.series.end(),
                                     [](const auto& column) { return column.name == "momentum"; });
  REQUIRE(momentum != stored.series.end());
  CHECK(momentum->components == 3);
  CHECK(momentum->unit == "kg m/s");
}

TEST_CASE("a run that is cut short stays recoverable, and is not written over") {
  const Folder folder;
  const SyntheticRun run({.seed = 3});
  const auto path = folder.path / "run.vtkhdf", part = io::part_path(path);
  Diagnostics diagnostics;
  {
    const auto writer = TrajectoryWriter::create(path, run.description(), {}, diagnostics);
    REQUIRE(writer);
    for (std::int64_t i = 0; i < 7; ++i) REQUIRE(run.write(*writer, i, diagnostics));
  }
  CHECK_FALSE(std::filesystem::exists(path));
  const auto from_part = TrajectoryReader::open(part, diagnostics);
  REQUIRE(from_part);
  CHECK_FALSE(from_part->summary().complete);
  CHECK(run.difference(*from_part, 7) == "");

  Diagnostics refused;
  CHECK_FALSE(TrajectoryWriter::create(path, run.description(), {}, refused));
  CHECK(refused.all().front().kind == support::DiagnosticKind::Usage);
  CHECK(refused.all().front().help.find("gmsim recover") != std::string::npos);

  CHECK(io::recovered_path(part) == path);
  CHECK(io::recover(part, path, diagnostics) == 7);
  CHECK(std::filesystem::exists(part));
  const auto recovered = TrajectoryReader::open(path, diagnostics);
  REQUIRE(recovered);
  CHECK(run.difference(*recovered, 7) == "");
  CHECK(TrajectoryWriter::create(folder.path / "other.vtkhdf", run.description(), {.sync = true},
                                 diagnostics));
}

TEST_CASE("recovering a finished file copies it") {
  const Folder folder;
  const SyntheticRun run({.seed = 4, .dimension = 3, .polyhedra = true});
  write_run(run, folder.path / "run.vtkhdf", 5);
  Diagnostics diagnostics;
  const auto target = io::recovered_path(folder.path / "run.vtkhdf");
  CHECK(target == folder.path / "recovered-run.vtkhdf");
  CHECK(io::recover(folder.path / "run.vtkhdf", target, diagnostics) == 5);
  const auto reader = TrajectoryReader::open(target, diagnostics);
  REQUIRE(reader);
  CHECK(reader->summary().complete);
  CHECK(run.difference(*reader, 5) == "");
  CHECK_FALSE(io::recover(target, target, diagnostics));
  CHECK(run.difference(*TrajectoryReader::open(target, diagnostics), 5) == "");
}

TEST_CASE("reports behind the last frame are kept") {
  const Folder folder;
  const SyntheticRun run({.seed = 5});
  Diagnostics diagnostics;
  const auto path = folder.path / "run.vtkhdf";
  const auto writer = TrajectoryWriter::create(path, run.description(), {}, diagnostics);
  REQUIRE(run.write(*writer, 0, diagnostics));
  const std::vector<double> report = {77, 1.5, 1, 2, 3};
  writer->add_report(report);
  REQUIRE(writer->close("", diagnostics));
  CHECK(io::recover(path, folder.path / "copy.vtkhdf", diagnostics) == 1);
  for (const char* name : {"run.vtkhdf", "copy.vtkhdf"}) {
    const auto reader = TrajectoryReader::open(folder.path / name, diagnostics);
    REQUIRE(reader);
    CHECK(reader->summary().reports == static_cast<std::int64_t>(run.frame(0).reports.size()) + 1);
    for (std::size_t column = 0; column < 3; ++column) {
      const auto values = reader->read_series(column, diagnostics);
      REQUIRE(values);
      const std::string& series = reader->run().series[column].name;
      CHECK(values->back() == (series == "step" ? 77 : series == "time" ? 1.5 : 3));
    }
  }
}

TEST_CASE("what cannot be written or read is said") {
  const Folder folder;
  const SyntheticRun run({.seed = 6});
  const auto create_error = [&](const std::filesystem::path& path,
                                const io::RunDescription& description) {
    Diagnostics diagnostics;
    CHECK_FALSE(TrajectoryWriter::create(path, description, {}, diagnostics));
    return message_of(diagnostics);
  };
  CHECK(create_error("/nowhere/run.vtkhdf", run.description()) ==
        "/nowhere/run.vtkhdf.part: cannot create the file: No such file or directory");
  auto description = run.description();
  description.fields[0].name = "norm(a.b)";
  CHECK(create_error(folder.path / "a.vtkhdf", description) ==
        "`norm(a.b)` cannot be the name of a field; `norm_a_b` can");
  description = run.description();
  description.fields[1].name = "velocity";
  CHECK(create_error(folder.path / "a.vtkhdf", description) == "two fields are called `velocity`");

  const auto open_error = [&](const std::filesystem::path& path) {
    Diagnostics diagnostics;
    CHECK_FALSE(TrajectoryReader::open(path, diagnostics));
    Diagnostics of_recovery;
    CHECK_FALSE(io::recover(path, folder.path / "target.vtkhdf", of_recovery));
    CHECK(message_of(of_recovery).find(message_of(diagnostics).substr(0, 40)) == 0);
    return message_of(diagnostics);
  };
  CHECK(open_error(folder.path / "none").find("there is no such file") != std::string::npos);
  std::ofstream(folder.path / "text") << "hello\n";
  CHECK(open_error(folder.path / "text").find("cannot open the file") != std::string::npos);

  Diagnostics diagnostics;
  const auto empty =
      TrajectoryWriter::create(folder.path / "empty.vtkhdf", run.description(), {}, diagnostics);
  REQUIRE(empty->close("", diagnostics));
  CHECK(diagnostics.all().front().severity == support::Severity::Warning);
  CHECK_FALSE(std::filesystem::exists(folder.path / "empty.vtkhdf"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "empty.vtkhdf.part"));
  {
    const auto stub =
        TrajectoryWriter::create(folder.path / "stub.vtkhdf", run.description(), {}, diagnostics);
  }
  CHECK(open_error(folder.path / "stub.vtkhdf.part").find("no frame of this run was finished") !=
        std::string::npos);
}

TEST_CASE("a truncated file is an error, never a crash") {
  const Folder folder;
  const SyntheticRun run({.seed = 8, .dimension = 3, .polyhedra = true});
  write_run(run, folder.path / "run.vtkhdf", 4);
  std::ifstream in(folder.path / "run.vtkhdf", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t length = 0; length < bytes.size(); length += bytes.size() / 25) {
    std::ofstream(folder.path / "cut.vtkhdf", std::ios::binary) << bytes.substr(0, length);
    Diagnostics diagnostics;
    const auto reader = TrajectoryReader::open(folder.path / "cut.vtkhdf", diagnostics);
    if (reader)
      CHECK(run.difference(*reader, 4) != "");
    else
      CHECK(diagnostics.has_errors());
  }
}

TEST_CASE("frames are chosen for export, and named by their numbers") {
  const Folder folder;
  const SyntheticRun run({.seed = 12});
  write_run(run, folder.path / "run.vtkhdf", 10);
  Diagnostics diagnostics;
  const auto reader = TrajectoryReader::open(folder.path / "run.vtkhdf", diagnostics);
  REQUIRE(reader);
  const auto names = [&](io::ExportOptions options) {
    const auto files =
        io::export_trajectory(*reader, folder.path / "out", "run", options, diagnostics);
    std::vector<std::string> result;
    if (files) {
      for (const auto& file : *files) {
        CHECK(std::filesystem::exists(file));
        result.push_back(file.filename().string());
      }
    }
    return result;
  };
  using Names = std::vector<std::string>;
  using io::ExportFormat;
  CHECK(names({.format = ExportFormat::Pvd, .first = 0, .last = -1, .every = 4}) ==
        Names{"run.pvd", "run_0000.vtu", "run_0004.vtu", "run_0008.vtu"});
  CHECK(names({.format = ExportFormat::Obj, .first = -2}) == Names{"run_0008.obj", "run_0009.obj"});
  CHECK(names({.format = ExportFormat::Usd, .first = 3, .last = 3}) == Names{"run.usda"});
  CHECK_FALSE(diagnostics.has_errors());
  CHECK(names({.first = 10}).empty());
  CHECK(diagnostics.all().back().message ==
        "there are no frames from 10 to -1 by 1; the file has 0 to 9");
  CHECK(io::find_export_format("usd") == ExportFormat::Usd);
  CHECK_FALSE(io::find_export_format("stl"));
}

TEST_CASE("names of fields") {
  CHECK(io::field_name("norm(force_on(vertex(a)))") == "norm_force_on_vertex_a");
  CHECK(io::field_name("velocity") == "velocity");
  CHECK(io::field_name("  (a.x + 1)/2 ") == "a_x_1_2");
  CHECK(io::field_name("()") == "field");
  CHECK(io::is_field_name("a+b"));
  for (const char* bad : {"", "a/b", "a.b", "a b", "\xc3\xa4"}) CHECK_FALSE(io::is_field_name(bad));
}

TEST_CASE("SHA-256: the test vectors of FIPS 180-4") {
  CHECK(io::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(io::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(io::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(io::sha256(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}
