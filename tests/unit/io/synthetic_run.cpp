// SPDX-License-Identifier: MIT
#include "unit/io/synthetic_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace gmsim::test {

namespace {

using io::FieldPlace;
using io::NumberType;
using io::VtkCell;

/// A generator for one purpose at one frame.
std::mt19937 generator(std::uint32_t seed, std::int64_t frame, std::uint32_t purpose) {
  std::seed_seq sequence = {seed, static_cast<std::uint32_t>(frame), purpose};
  return std::mt19937(sequence);
}

double rounded(double value, NumberType type) {
  switch (type) {
    case NumberType::Float64:
      return value;
    case NumberType::Float32:
      return static_cast<double>(static_cast<float>(value));
    case NumberType::Int64:
    case NumberType::Int32:
      return std::round(value);
  }
  return value;
}

std::vector<double> random_values(std::mt19937 random, std::size_t count, NumberType type) {
  std::uniform_real_distribution<> real(-1e4, 1e4);
  std::vector<double> values(count);
  for (double& value : values) value = rounded(real(random), type);
  return values;
}

std::vector<std::int32_t> distinct(std::mt19937& random, std::size_t count, std::size_t end) {
  std::vector<std::int32_t> numbers;
  while (numbers.size() < count) {
    const auto number = static_cast<std::int32_t>(random() % end);
    if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
      numbers.push_back(number);
  }
  return numbers;
}

void add_solid(std::mt19937& random, std::size_t points, bool polyhedra, io::MeshTopology& mesh) {
  constexpr std::array<std::pair<VtkCell, std::size_t>, 4> kSolids = {{{VtkCell::Tetrahedron, 4},
                                                                       {VtkCell::Hexahedron, 8},
                                                                       {VtkCell::Wedge, 6},
                                                                       {VtkCell::Pyramid, 5}}};
  const std::size_t choice = random() % (polyhedra ? 5 : 4);
  if (choice < 4) {
    mesh.add_cell(kSolids[choice].first, distinct(random, kSolids[choice].second, points));
    return;
  }
  const auto p = distinct(random, 5, points);  // two tetrahedra face to face
  mesh.add_polyhedron({{p[0], p[1], p[3]},
                       {p[1], p[2], p[3]},
                       {p[2], p[0], p[3]},
                       {p[1], p[0], p[4]},
                       {p[2], p[1], p[4]},
                       {p[0], p[2], p[4]}});
}

enum Field : std::size_t {
  Velocity,
  Mass,
  Dart,
  Stress,
  Material,
  Counter,
  Energy,
  Events,
  CornerForce,
  kFields
};

bool constant_in_epoch(std::size_t field) {
  return field == Mass || field == Dart || field == Material;
}

template <class Number>
std::vector<Number> as(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

io::RunDescription SyntheticRun::description() const {
  io::RunDescription run;
  run.dimension = options_.dimension;
  run.scene = "dimension: 2  # größer\nbodies: []\n";
  run.rules = {
      {"springs", "stdlib-rules/springs.rule", "interaction stretch_spring on <0>(a) {}\n"},
      {"tear", "./tear.rule", ""}};
  run.rule_names = {"separate_elements", "split_vertex"};
  run.criterion_names = {"global_facet_force"};
  run.program_version = "0.1.0";
  run.commit = "0123456789abcdef";
  run.command = "gmsim scene.yaml --set integrator.dt=1e-3";
  run.started = "2026-01-02T03:04:05Z";
  run.seed = options_.seed;
  run.fields = {
      {"velocity", 3, FieldPlace::Point, NumberType::Float64, "velocity", "<1,2>", "m/s"},
      {"mass", 1, FieldPlace::Point, NumberType::Float32, "mass", "<1,2>", "kg"},
      {"dart", 1, FieldPlace::Point, NumberType::Int32, "", "<1,2>", ""},
      {"stress", 6, FieldPlace::Cell, NumberType::Float32, "stress", "<0,1>", "Pa"},
      {"material", 1, FieldPlace::Cell, NumberType::Int32, "", "<0,1>", ""},
      {"counter", 2, FieldPlace::Cell, NumberType::Int64, "", "<0,1>", ""},
      {"kinetic_energy", 1, FieldPlace::Frame, NumberType::Float64, "", "", "J"},
      {"events_so_far", 1, FieldPlace::Frame, NumberType::Int64, "", "", ""},
      {"corner_force", 3, FieldPlace::Orbit, NumberType::Float32, "corner_force", "<1>", "N"}};
  run.series = {{"step", 1, NumberType::Int64, ""},
                {"time", 1, NumberType::Float64, "s"},
                {"momentum", 3, NumberType::Float64, "kg m/s"}};
  run.polyhedra = options_.polyhedra;
  for (std::int32_t i = 0; i < 4 * (options_.dimension + 1); ++i) run.alpha.push_back(i / 4);
  run.expected_points = options_.points;
  run.expected_cells = options_.points;
  return run;
}

bool SyntheticRun::begins_epoch(std::int64_t frame) const {
  return frame == 0 || generator(options_.seed, frame, 1)() % 3 == 0;
}

std::int64_t SyntheticRun::first_frame_of_epoch(std::int64_t frame) const {
  while (!begins_epoch(frame)) --frame;
  return frame;
}

io::MeshTopology SyntheticRun::mesh(std::int64_t epoch_frame, std::size_t points) const {
  auto random = generator(options_.seed, epoch_frame, 2);
  io::MeshTopology mesh;
  // Now and then nothing is left of the mesh.
  const std::size_t cells =
      epoch_frame > 0 && random() % 8 == 0 ? 0 : 1 + random() % options_.points;
  for (std::size_t i = 0; i < cells; ++i) {
    if (options_.dimension == 3) {
      add_solid(random, points, options_.polyhedra && random() % 2 == 0, mesh);
    } else {
      const std::size_t corners = 3 + random() % 5;
      mesh.add_cell(io::polygon_type(corners), distinct(random, corners, points));
    }
  }
  return mesh;
}

SyntheticRun::Frame SyntheticRun::frame(std::int64_t number) const {
  Frame frame;
  const std::int64_t first = first_frame_of_epoch(number);
  auto of_epoch = generator(options_.seed, first, 3);
  auto of_frame = generator(options_.seed, number, 4);
  frame.time = 0.02 * static_cast<double>(number);
  frame.step = 20 * number;
  frame.epoch = -1;
  for (std::int64_t i = 0; i <= number; ++i) frame.epoch += begins_epoch(i) ? 1 : 0;
  frame.begins_epoch = first == number;
  const std::size_t points = options_.points + of_epoch() % options_.points;
  const auto flat = random_values(of_frame, 3 * points, NumberType::Float64);
  for (std::size_t i = 0; i < points; ++i)
    frame.points.push_back({flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]});
  frame.mesh = mesh(first, points);
  if (frame.begins_epoch) {
    const auto rows = static_cast<std::int32_t>(of_frame() % 4);
    for (std::int32_t i = 0; i < rows * (options_.dimension + 2); ++i)
      frame.changes.push_back(i - 1);
  }
  const auto fields = description().fields;
  const std::size_t orbits = of_frame() % 5;
  for (std::size_t i = 0; i < kFields; ++i) {
    const std::size_t rows = fields[i].place == FieldPlace::Point   ? points
                             : fields[i].place == FieldPlace::Cell  ? frame.mesh.cell_count()
                             : fields[i].place == FieldPlace::Orbit ? orbits
                                                                    : 1;
    const std::int64_t since = constant_in_epoch(i) ? first : number;
    frame.fields.push_back(
        random_values(generator(options_.seed, since, 10 + static_cast<std::uint32_t>(i)),
                      rows * fields[i].components, fields[i].type));
  }
  for (std::size_t i = 0; i < orbits; ++i) frame.darts.push_back(static_cast<std::int32_t>(i * 7));
  for (std::size_t i = 0; i < of_frame() % 3; ++i) {
    const auto n = static_cast<std::int32_t>(i);
    frame.events.push_back({frame.step - n,
                            frame.time,
                            n % 2,
                            0,
                            0.5 + n,
                            0.25,
                            3 * n,
                            {1.5, 2.5, -n * 1.0},
                            n,
                            std::vector<std::int32_t>(i + 1, n)});
  }
  for (std::size_t i = 0; i < of_frame() % 4; ++i) {
    frame.reports.push_back(
        {static_cast<double>(frame.step) + static_cast<double>(i), frame.time, 1.25, -2.5, 1e-300});
  }
  return frame;
}

bool SyntheticRun::write(io::TrajectoryWriter& writer, std::int64_t number,
                         support::Diagnostics& diagnostics) const {
  const Frame frame = this->frame(number);
  for (const auto& report : frame.reports) writer.add_report(report);
  const auto types = description().fields;
  std::vector<std::vector<float>> floats(kFields);
  std::vector<std::vector<std::int64_t>> longs(kFields);
  std::vector<std::vector<std::int32_t>> ints(kFields);
  std::vector<io::FrameField> fields(kFields);
  for (std::size_t i = 0; i < kFields; ++i) {
    if (constant_in_epoch(i) && !frame.begins_epoch) continue;
    switch (types[i].type) {
      case NumberType::Float64:
        fields[i].values = std::span(frame.fields[i]);
        break;
      case NumberType::Float32:
        fields[i].values = std::span<const float>(floats[i] = as<float>(frame.fields[i]));
        break;
      case NumberType::Int64:
        fields[i].values =
            std::span<const std::int64_t>(longs[i] = as<std::int64_t>(frame.fields[i]));
        break;
      case NumberType::Int32:
        fields[i].values =
            std::span<const std::int32_t>(ints[i] = as<std::int32_t>(frame.fields[i]));
        break;
    }
    if (types[i].place == FieldPlace::Orbit) fields[i].darts = frame.darts;
  }
  io::FrameData data;
  data.time = frame.time;
  data.step = frame.step;
  data.points = frame.points;
  if (frame.begins_epoch) data.topology = io::NewTopology{&frame.mesh, 100 + number, frame.changes};
  data.fields = fields;
  data.events = frame.events;
  return writer.write_frame(data, diagnostics);
}

std::string SyntheticRun::frame_difference(const io::TrajectoryReader& reader,
                                           std::int64_t number) const {
  const Frame expected = frame(number);
  const auto at = static_cast<std::size_t>(number);
  support::Diagnostics diagnostics;
  const auto mesh = reader.read_frame(number, false, diagnostics);
  if (!mesh) return fmt::format("frame {}: {}", number, diagnostics.all().front().message);
  const auto differs = [&](const char* what) {
    return fmt::format("frame {}: {} differ", number, what);
  };
  if (reader.times()[at] != expected.time || mesh->time != expected.time) return differs("times");
  if (reader.steps()[at] != expected.step) return differs("steps");
  if (reader.epoch_of()[at] != expected.epoch) return differs("epochs");
  if (mesh->points != expected.points) return differs("points");
  if (!(mesh->topology == expected.mesh)) return differs("cells");
  const auto types = description().fields;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const auto& stored = reader.run().fields;
    const auto found = std::find_if(stored.begin(), stored.end(), [&](const auto& field) {
      return field.name == types[i].name && field.place == types[i].place;
    });
    if (found == stored.end()) return differs(types[i].name.c_str());
    const auto place = static_cast<std::size_t>(found - stored.begin());
    const auto field = reader.read_field(place, number, diagnostics);
    if (!field || field->values != expected.fields[i]) return differs(types[i].name.c_str());
    if (types[i].place != FieldPlace::Orbit) continue;
    const auto orbits = reader.read_orbit_field(place, number, diagnostics);
    if (!orbits || orbits->darts != expected.darts) return differs("darts");
  }
  return "";
}

std::string SyntheticRun::difference(const io::TrajectoryReader& reader,
                                     std::int64_t frames) const {
  if (reader.summary().frames != frames) {
    return fmt::format("{} frames instead of {}", reader.summary().frames, frames);
  }
  support::Diagnostics diagnostics;
  const auto events = reader.read_events(diagnostics);
  const auto epochs = reader.read_epochs(diagnostics);
  if (!events || !epochs) return diagnostics.all().front().message;
  std::size_t event = 0, epoch = 0, reports = 0;
  for (std::int64_t number = 0; number < frames; ++number) {
    const std::string difference = frame_difference(reader, number);
    if (!difference.empty()) return difference;
    const Frame expected = frame(number);
    reports += expected.reports.size();
    if (expected.begins_epoch) {
      if (epoch >= epochs->size()) return "an epoch is missing";
      const io::StoredEpoch& stored = (*epochs)[epoch++];
      if (stored.step != expected.step || stored.changes != expected.changes ||
          stored.darts != 100 + number || stored.first_event != static_cast<std::int64_t>(event)) {
        return fmt::format("epoch {} differs", epoch - 1);
      }
    }
    for (const io::TearEvent& wanted : expected.events) {
      if (event >= events->size()) return "an event is missing";
      const auto& [stored, at] = (*events)[event++];
      if (at != number || stored.step != wanted.step || stored.value != wanted.value ||
          stored.position != wanted.position || stored.cells != wanted.cells ||
          stored.new_vertices != wanted.new_vertices || stored.rule != wanted.rule) {
        return fmt::format("event {} differs", event - 1);
      }
    }
  }
  if (event != events->size()) return "there are events too many";
  if (epoch != epochs->size()) return "there are epochs too many";
  if (static_cast<std::int64_t>(reports) != reader.summary().reports) return "the reports differ";
  return "";
}

}  // namespace gmsim::test
