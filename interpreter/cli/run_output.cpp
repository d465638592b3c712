// SPDX-License-Identifier: MIT
#include "cli/run_output.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "cli/version.h"
#include "compile/expression_search.h"
#include "gmap/orbit_walk.h"

namespace gmsim::cli {
namespace {

using engine::DartId;
using io::NumberType;
using types::EmbeddingId;
using types::OrbitType;

/// A dart of every point, the meshes of the bodies one after another.
std::vector<DartId> point_darts(const scene::Scene& scene) {
  std::vector<DartId> darts;
  for (const scene::BodySummary& body : scene.bodies)
    darts.insert(darts.end(), body.vertices.begin(), body.vertices.end());
  return darts;
}

std::vector<std::int32_t> links_of(const gmap::GMap& map) {
  std::vector<std::int32_t> links;
  const int n = map.dimension();
  links.reserve(std::size_t{map.dart_end()} * (n + 1));
  for (std::uint32_t d = 0; d < map.dart_end(); ++d)
    for (int i = 0; i <= n; ++i)
      links.push_back(map.alive(DartId{d})
                          ? static_cast<std::int32_t>(types::index(map.alpha(i, DartId{d})))
                          : -1);
  return links;
}

/// "springs.stretch" for stdlib-rules/springs/stretch.rule; no name twice.
std::string module_name(const std::string& path, std::map<std::string, int>& used) {
  constexpr std::string_view kLibrary = "stdlib-rules/";
  std::string name = path.starts_with(kLibrary) ? path.substr(kLibrary.size())
                                                : std::filesystem::path(path).filename().string();
  if (name.ends_with(".rule")) name.resize(name.size() - 5);
  std::replace(name.begin(), name.end(), '/', '.');
  const int count = used[name]++;
  return count == 0 ? name : fmt::format("{}_{}", name, count + 1);
}

std::vector<io::RuleSource> rule_sources(const scene::Scene& scene,
                                         const support::SourceMap& sources) {
  std::vector<io::RuleSource> rules;
  std::map<std::string, int> used;
  for (const auto& file : scene.rules.files()) {
    const std::string& path = sources.name(file.file);
    rules.push_back({module_name(path, used), path, std::string(sources.text(file.file))});
  }
  return rules;
}

std::vector<io::SeriesDescription> series() {
  return {{"step", 1, NumberType::Int64, ""},
          {"time", 1, NumberType::Float64, "s"},
          {"dt", 1, NumberType::Float64, "s"},
          {"kinetic", 1, NumberType::Float64, "J"},
          {"potential", 1, NumberType::Float64, "J"},
          {"momentum", 3, NumberType::Float64, "kg m/s"},
          {"angular_momentum", 3, NumberType::Float64, "kg m^2/s"},
          {"evaluations", 1, NumberType::Int64, ""},
          {"max_elongation", 1, NumberType::Float64, ""},
          {"points", 1, NumberType::Int64, ""},
          {"cells", 1, NumberType::Int64, ""}};
}

FrameColumn embedding_column(const gmap::EmbeddingSchema& schema, EmbeddingId id,
                             NumberType type) {
  const gmap::EmbeddingDecl& about = schema[id];
  io::FieldDescription field{about.name, types::component_count(about.type), io::FieldPlace::Point,
                             type, about.name, "", about.unit ? types::to_string(*about.unit) : ""};
  return {field, about.orbit, [id](engine::TreeEvaluator& evaluator, DartId dart, std::span<double> out) {
            return evaluator.read(id, dart, out);
          }};
}

FrameColumn dart_column(io::FieldPlace place, OrbitType orbit) {
  return {{"dart", 1, place, NumberType::Int32, "", "", ""},
          orbit,
          [](engine::TreeEvaluator&, DartId dart, std::span<double> out) {
            out[0] = types::index(dart);
            return true;
          }};
}

/// The number of the body that a cell belongs to, in the order of the scene.
FrameColumn body_column(const scene::Scene& scene, OrbitType cell) {
  std::vector<double> body_of_point;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    body_of_point.insert(body_of_point.end(), scene.bodies[body].vertices.size(),
                         static_cast<double>(body));
  return {{"body", 1, io::FieldPlace::Cell, NumberType::Int32, "", "", ""},
          cell,
          [&scene, body_of_point](engine::TreeEvaluator&, DartId dart, std::span<double> out) {
            // A dart that a rule made belongs where the oldest dart of its piece does.
            const gmap::GMap& map = scene.state->map;
            if (types::index(dart) >= scene.dart_point.size())
              dart = gmap::smallest_dart(map, OrbitType::range(0, map.dimension()), dart);
            out[0] = types::index(dart) < scene.dart_point.size()
                         ? body_of_point[scene.dart_point[types::index(dart)]]
                         : -1;
            return true;
          }};
}

std::string now_text() {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(
      std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

}  // namespace

RunOutput::RunOutput(const scene::Scene& scene)
    : scene_(scene),
      vertices_(scene.state->store.use_index(OrbitType::cell(0, scene.program.dimension))),
      position_(*scene.state->store.schema().find("position")),
      numbering_(vertices_, point_darts(scene)) {}

std::unique_ptr<RunOutput> RunOutput::create(const scene::Scene& scene,
                                             const support::SourceMap& sources,
                                             const Options& options,
                                             support::Diagnostics& diagnostics) {
  std::unique_ptr<RunOutput> output(new RunOutput(scene));
  output->make_mesh();
  output->links_ = links_of(scene.state->map);
  if (!output->make_columns(diagnostics)) return nullptr;
  output->writer_ =
      io::TrajectoryWriter::create(options.path, output->describe(sources, options),
                                   {.force = options.force, .sync = scene.output.sync}, diagnostics);
  return output->writer_ ? std::move(output) : nullptr;
}

/// Velocities with all their digits, so that a run can go on from a frame; masses and darts; and
/// what the scene asks for.
bool RunOutput::make_columns(support::Diagnostics& diagnostics) {
  const int n = scene_.program.dimension;
  const OrbitType vertex = OrbitType::cell(0, n), cell = OrbitType::cell(n, n);
  const auto& schema = scene_.state->store.schema();
  const auto asked = [&](std::string_view name) {
    return std::any_of(scene_.output.fields.begin(), scene_.output.fields.end(),
                       [&](const scene::OutputField& field) { return field.name == name; });
  };
  const auto add_embedding = [&](const char* name, NumberType type) {
    const auto id = schema.find(name);
    if (id && schema[*id].orbit == vertex) columns_.push_back(embedding_column(schema, *id, type));
  };
  add_embedding("velocity", NumberType::Float64);
  if (!asked("mass")) add_embedding("mass", NumberType::Float32);
  if (!asked("dart")) {
    columns_.push_back(dart_column(io::FieldPlace::Point, vertex));
    columns_.push_back(dart_column(io::FieldPlace::Cell, cell));
  }
  if (!asked("body") && scene_.bodies.size() > 1) columns_.push_back(body_column(scene_, cell));
  for (const scene::OutputField& field : scene_.output.fields)
    if (field.name != "velocity" || field.text != "velocity")
      columns_.emplace_back(field, n);
  const bool reads_forces = std::ranges::any_of(scene_.output.fields, [&](const auto& field) {
    return compile::reads_forces(*field.value.value, schema);
  });
  if (reads_forces) probe_ = engine::ForceProbe::create(*scene_.state, scene_.model, diagnostics);
  return !reads_forces || probe_;
}

void RunOutput::make_mesh() {
  const auto& store = scene_.state->store;
  mesh_ = io::mesh_frame_from_map(scene_.state->map, vertices_, numbering_, [&](DartId dart) {
    const auto value = store.get(position_, dart);
    return std::array<double, 3>{value[0], value[1], value[2]};
  });
}

io::RunDescription RunOutput::describe(const support::SourceMap& sources,
                                       const Options& options) const {
  io::RunDescription run;
  run.dimension = scene_.program.dimension;
  run.scene = scene_.resolved;
  run.rules = rule_sources(scene_, sources);
  run.program_version = version();
  run.commit = commit();
  run.command = options.command_line;
  run.started = now_text();
  run.seed = scene_.seed;
  for (const FrameColumn& column : columns_) run.fields.push_back(column.description());
  run.series = series();
  run.polyhedra = mesh_.mesh.topology.has_polyhedra();
  run.alpha = links_;
  for (const engine::TearPairing& tear : scene_.model.tears) {
    const auto& program = scene_.program;
    run.criterion_names.push_back(program.criteria[tear.criterion].name);
    run.rule_names.push_back(tear.change.operation ? program.operations[tear.change.target].name
                                                   : program.rules[tear.change.target].name);
  }
  run.expected_points = mesh_.mesh.points.size();
  run.expected_cells = mesh_.mesh.topology.cell_count();
  return run;
}

std::span<const DartId> RunOutput::darts_of(const FrameColumn& column) {
  if (column.description().place == io::FieldPlace::Point) return mesh_.point_darts;
  if (column.description().place == io::FieldPlace::Cell) return mesh_.cell_darts;
  orbit_darts_ = gmap::all_orbits(scene_.state->map, column.orbit());
  return orbit_darts_;
}

void RunOutput::note(const engine::StepReport& step) {
  map_changed_ = map_changed_ || step.map_changed;
  for (const engine::TearEvent& event : step.events) {
    io::TearEvent row{.step = static_cast<std::int64_t>(event.step), .time = event.time,
                      .rule = static_cast<std::int32_t>(event.pairing),
                      .criterion = static_cast<std::int32_t>(event.pairing), .value = event.value,
                      .threshold = event.threshold,
                      .dart = static_cast<std::int32_t>(types::index(event.dart)),
                      .position = event.position,
                      .new_vertices = static_cast<std::int32_t>(event.split + event.created),
                      .cells = {}};
    row.cells.push_back(row.dart);
    events_.push_back(std::move(row));
  }
}

io::NewTopology RunOutput::take_topology() {
  const gmap::GMap& map = scene_.state->map;
  const std::size_t width = static_cast<std::size_t>(map.dimension()) + 1;
  changes_.clear();
  if (frames_ > 0) {
    numbering_.update(vertices_);
    make_mesh();
    const std::vector<std::int32_t> links = links_of(map);
    links_.resize(links.size(), -1);
    for (std::size_t d = 0; d < links.size() / width; ++d) {
      const auto now = links.begin() + static_cast<std::ptrdiff_t>(d * width);
      const auto then = links_.begin() + static_cast<std::ptrdiff_t>(d * width);
      if (std::equal(now, now + static_cast<std::ptrdiff_t>(width), then)) continue;
      changes_.push_back(static_cast<std::int32_t>(d));
      changes_.insert(changes_.end(), now, now + static_cast<std::ptrdiff_t>(width));
    }
    links_ = links;
  }
  map_changed_ = false;
  return {&mesh_.mesh.topology, map.dart_end(), changes_};
}

bool RunOutput::write_state(double time, std::int64_t step, support::Diagnostics& diagnostics) {
  std::optional<io::NewTopology> topology;
  if (frames_ == 0 || map_changed_) topology = take_topology();
  const auto& position = scene_.state->store.column(position_);
  const auto rows = numbering_.rows();
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const auto value = position.get(rows[point]);
    mesh_.mesh.points[point] = {value[0], value[1], value[2]};
  }
  engine::TreeEvaluator evaluator(*scene_.state);
  if (probe_) {
    if (!probe_->update(diagnostics)) return false;
    evaluator.read_forces(&probe_->forces());
  }
  std::vector<io::FrameField> fields;
  for (FrameColumn& column : columns_) {
    if (!column.evaluate(evaluator, darts_of(column), diagnostics)) return false;
    fields.push_back(column.frame_field());
  }
  io::FrameData frame;
  frame.time = time;
  frame.step = step;
  frame.points = mesh_.mesh.points;
  frame.fields = fields;
  frame.topology = topology;
  frame.events = events_;
  if (!writer_->write_frame(frame, diagnostics)) return false;
  events_.clear();
  ++frames_;
  last_time_ = time;
  return true;
}

bool RunOutput::write_frame(engine::Simulation& simulation, support::Diagnostics& diagnostics) {
  simulation.sync();
  return write_state(simulation.time(), static_cast<std::int64_t>(simulation.steps()), diagnostics);
}

bool RunOutput::write_frame_at(double time, const engine::StepReport& step,
                               engine::Simulation& simulation,
                               support::Diagnostics& diagnostics) {
  std::vector<double> positions;
  simulation.dense_positions(time, positions);
  const std::vector<double> velocities =
      dense_velocities(simulation, step.time - step.dt, step.time, time);
  engine::State& state = *scene_.state;
  auto& position = state.store.column(position_);
  auto& velocity = state.store.column(*state.store.schema().find("velocity"));
  for (const gmap::Row row : numbering_.rows()) {
    position.set(row, std::span(positions).subspan(3 * std::size_t{row}, 3));
    velocity.set(row, std::span(velocities).subspan(3 * std::size_t{row}, 3));
  }
  state.time = time;
  const bool written =
      write_state(time, static_cast<std::int64_t>(simulation.steps()), diagnostics);
  simulation.sync();
  return written;
}

void RunOutput::add_report(const RunReport& report, const engine::Simulation& simulation) {
  const engine::Totals& totals = report.totals;
  const std::array row = {static_cast<double>(simulation.steps()),
                          report.step.time,
                          report.step.dt,
                          totals.kinetic,
                          totals.potential,
                          totals.momentum[0],
                          totals.momentum[1],
                          totals.momentum[2],
                          totals.angular_momentum[0],
                          totals.angular_momentum[1],
                          totals.angular_momentum[2],
                          static_cast<double>(simulation.evaluations()),
                          report.max_elongation,
                          static_cast<double>(vertices_.orbit_count()),
                          static_cast<double>(cell_count())};
  writer_->add_report(row);
}

std::size_t RunOutput::cell_count() const {
  if (!map_changed_) return mesh_.mesh.topology.cell_count();
  const int n = scene_.program.dimension;
  return gmap::all_orbits(scene_.state->map, OrbitType::range(0, n - 1)).size();
}

bool RunOutput::close(std::uint64_t state_hash, std::string_view ending,
                      support::Diagnostics& diagnostics) {
  return writer_->close(fmt::format("{:016x}", state_hash), diagnostics, ending);
}

std::vector<double> dense_velocities(const engine::Simulation& simulation, double begin,
                                     double end, double time) {
  constexpr std::size_t kNodes = 6;
  std::array<double, kNodes> nodes;
  for (std::size_t j = 0; j < kNodes; ++j)
    nodes[j] = begin + (end - begin) * static_cast<double>(j) / (kNodes - 1);
  std::vector<double> velocities, positions;
  for (std::size_t j = 0; j < kNodes; ++j) {
    // Derivative at `time` of the Lagrange polynomial of node j.
    double weight = 0;
    for (std::size_t k = 0; k < kNodes; ++k) {
      if (k == j) continue;
      double product = 1 / (nodes[j] - nodes[k]);
      for (std::size_t m = 0; m < kNodes; ++m)
        if (m != j && m != k) product *= (time - nodes[m]) / (nodes[j] - nodes[m]);
      weight += product;
    }
    simulation.dense_positions(nodes[j], positions);
    velocities.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) velocities[i] += weight * positions[i];
  }
  return velocities;
}

}  // namespace gmsim::cli
