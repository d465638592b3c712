// SPDX-License-Identifier: MIT
#include "cli/study_point.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/scene_session.h"

namespace gmsim::cli {
namespace {

/// Below this share of the processor a timed run was disturbed.
constexpr double kUndisturbed = 0.95;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string first_error(const support::Diagnostics& diagnostics) {
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    if (diagnostic.severity == support::Severity::Error) return diagnostic.message;
  return "it stopped";
}

/// Runs that change the mesh cannot be compared vertex by vertex, nor be run twice from one state.
bool keeps_its_mesh(Session& session, const scene::Scene& scene) {
  const auto refuse = [&](const support::Span& place, const char* key) {
    session.diagnostics.report(
        {.kind = support::DiagnosticKind::Usage,
         .message = fmt::format("a study compares runs that keep their mesh, and `{}` changes it", key),
         .place = place,
         .help = "leave it out, or compare runs by what they expect: `gmsim verify`"});
  };
  for (const engine::TearPairing& tear : scene.model.tears) refuse(tear.span, "tear");
  for (const engine::StandingRewrite& rewrite : scene.model.rewrites) refuse(rewrite.span, "rewrite");
  return scene.model.tears.empty() && scene.model.rewrites.empty();
}

/// The point as overrides of the scene.
std::vector<std::string> overrides(const StudyPoint& point) {
  std::vector<std::string> texts = {"integrator.method=" + point.method};
  if (point.adaptive) {
    texts.push_back(fmt::format("integrator.rtol={}", point.rtol));
    if (point.dt > 0) texts.push_back(fmt::format("integrator.dt_max={}", point.dt));
  } else {
    texts.push_back(fmt::format("integrator.dt={}", point.dt));
  }
  texts.emplace_back("integrator.on_unstable=warn");  // so that the limit is known
  return texts;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double median_deviation(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - middle));
  return median(distances);
}

StudyScene::StudyScene(Session& session, std::unique_ptr<scene::Scene> scene)
    : session_(session), scene_(std::move(scene)) {}

std::unique_ptr<StudyScene> StudyScene::load(Session& session, StudyPoint& point) {
  auto scene = load_scene(session, overrides(point));
  if (!scene || !keeps_its_mesh(session, *scene)) return nullptr;
  return std::unique_ptr<StudyScene>(new StudyScene(session, std::move(scene)));
}

std::unique_ptr<engine::Simulation> StudyScene::make(support::Diagnostics& diagnostics) const {
  engine::SimulationOptions options;
  options.threads = session_.options.run.threads;
  options.tree_kernel = session_.options.run.tree_kernel;
  return engine::Simulation::create(*scene_->state, scene_->model, scene_->integrator, options,
                                    diagnostics);
}

bool StudyScene::advance(engine::Simulation& simulation, support::Diagnostics& diagnostics) const {
  while (simulation.time() < scene_->duration)
    if (!simulation.step(next_stop(*scene_, simulation.time()), diagnostics)) return false;
  return true;
}

void StudyScene::run(StudyPoint& point) const {
  support::Diagnostics diagnostics;
  const auto simulation = make(diagnostics);
  if (!simulation) {
    point.problem = first_error(diagnostics);
    return;
  }
  const double limit = simulation->limit().dt_global;
  if (std::isfinite(limit)) point.dt_over_limit = simulation->dt() / limit;
  if (!point.adaptive && point.dt_over_limit > 1) {
    point.problem = fmt::format("unstable: the limit is {:.4g} s", limit);
    return;
  }
  if (!advance(*simulation, diagnostics)) {
    point.problem = first_error(diagnostics);
    return;
  }
  point.steps = simulation->steps();
  point.evaluations = simulation->evaluations();
  point.state_hash = simulation->state_hash();
  simulation->dense_positions(simulation->time(), point.positions);
}

bool StudyScene::time(StudyPoint& point, std::uint32_t count) const {
  std::vector<std::unique_ptr<engine::Simulation>> simulations;
  support::Diagnostics diagnostics;
  for (std::uint32_t i = 0; i < count; ++i) simulations.push_back(make(diagnostics));
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = cpu_seconds();
  for (const auto& simulation : simulations) advance(*simulation, diagnostics);
  const double cpu = cpu_seconds() - cpu_begin;
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  point.wall.push_back(wall / count);
  if (wall > 0) point.cpu_over_wall = std::min(point.cpu_over_wall, cpu / wall);
  point.disturbed = session_.options.run.threads == 1 && point.cpu_over_wall < kUndisturbed;
  return std::all_of(simulations.begin(), simulations.end(), [&](const auto& simulation) {
    return simulation->state_hash() == point.state_hash;
  });
}

double StudyScene::diagonal() const {
  const auto& store = scene_->state->store;
  const types::EmbeddingId position = *store.schema().find("position");
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  const gmap::OrbitIndex& vertices = store.index_of(position);
  for (gmap::Row row = 0; row < vertices.row_end(); ++row) {
    if (!vertices.alive(row)) continue;
    const auto value = store.column(position).get(row);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], value[k]);
      high[k] = std::max(high[k], value[k]);
    }
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace gmsim::cli
