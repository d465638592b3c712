// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>
#include <random>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/run_cli.h"
#include "cli/study_report.h"
#include "engine/integrators.h"
#include "io/sha256.h"
#include "io/text_file.h"
#include "support/suggest.h"

namespace gmsim::cli {
namespace {

using support::DiagnosticKind;

/// Runs of the reference method are this much finer than the finest step of the study.
constexpr double kFiner = 8;
/// Timed runs of a point take at least so long together (s); short runs are repeated for it.
constexpr double kTimedSeconds = 1;
constexpr double kReferenceTolerance = 1e-12;

class StudyJob {
 public:
  explicit StudyJob(Session& session) : session_(session), options_(session.options.study) {}

  int run() {
    if (!plan() || !run_reference() || !run_points()) return stop();
    report_.compare();
    if (!time_points()) return stop();
    session_.out << study_table(report_);
    if (!options_.folder.empty()) write();
    return session_.finish();
  }

 private:
  int stop() {
    const int code = session_.finish();
    if (!watch_.interrupted()) return code;
    session_.err << "interrupted; nothing was written\n";
    return kInterrupted;
  }

  bool plan() {
    for (const std::string& method : options_.methods) plan_method(method);
    if (!session_.diagnostics.has_errors() && !engine::find_integrator(options_.reference_method))
      report_unknown(options_.reference_method);
    report_.threads = session_.options.run.threads;
    report_.machine = this_machine();
    report_.command_line = session_.options.command_line;
    return !session_.diagnostics.has_errors();
  }

  void plan_method(const std::string& method) {
    const engine::IntegratorInfo* info = engine::find_integrator(method);
    if (!info) return report_unknown(method);
    StudyPoint point;
    point.method = method;
    point.adaptive = info->adaptive;
    for (const double value : info->adaptive ? options_.tolerances : options_.steps) {
      (info->adaptive ? point.rtol : point.dt) = value;
      report_.points.push_back(point);
    }
    if (!info->adaptive && options_.steps.empty())
      session_.diagnostics.report(
          {.kind = DiagnosticKind::Usage,
           .message = fmt::format("`{}` has a fixed step, and `--dt` gives none", method)});
  }

  void report_unknown(const std::string& method) {
    std::vector<std::string> names;
    for (const auto& info : engine::integrators()) names.emplace_back(info.name);
    std::string help = support::did_you_mean(method, names);
    if (help.empty()) help = fmt::format("methods are {}", fmt::join(names, ", "));
    session_.diagnostics.report({.kind = DiagnosticKind::UnknownIntegrator,
                                 .message = fmt::format("no method is called `{}`", method),
                                 .help = help});
  }

  [[nodiscard]] StudyPoint reference_point(double dt) const {
    StudyPoint point;
    point.method = options_.reference_method;
    point.adaptive = engine::find_integrator(point.method)->adaptive;
    point.dt = dt;
    point.rtol = kReferenceTolerance;
    return point;
  }

  /// The step of the reference: as asked, else an eighth of the finest step of the study.
  [[nodiscard]] double reference_step() const {
    if (options_.reference_step) return *options_.reference_step;
    return *std::min_element(options_.steps.begin(), options_.steps.end()) / kFiner;
  }

  bool run_reference() {
    if (!options_.reference_step && options_.steps.empty()) {
      session_.diagnostics.report(
          {.kind = DiagnosticKind::Usage,
           .message = "without `--dt` the step of the reference is not known",
           .help = "give `--reference-dt`"});
      return false;
    }
    report_.reference = reference_point(reference_step());
    report_.coarser = reference_point(2 * reference_step());
    if (report_.coarser.adaptive) report_.coarser.rtol *= 100;
    for (StudyPoint* point : {&report_.reference, &report_.coarser}) {
      say(*point, "reference");
      const auto scene = StudyScene::load(session_, *point);
      if (!scene) return false;
      describe(*scene);
      scene->run(*point);
      if (point->has_result()) continue;
      session_.diagnostics.report(
          {.kind = DiagnosticKind::Usage,
           .message = fmt::format("the reference, {} at {} s, has no result: {}", point->method,
                                  point->dt, point->problem),
           .help = "a smaller `--reference-dt`, or another `--reference-method`"});
      return false;
    }
    return !watch_.interrupted();
  }

  void describe(const StudyScene& scene) {
    report_.scene = scene.scene().path.string();
    report_.duration = scene.scene().duration;
    report_.diagonal = scene.diagonal();
    report_.points_of_mesh = 0;
    for (const scene::BodySummary& body : scene.scene().bodies)
      report_.points_of_mesh += body.vertices.size();
    report_.scene_hash = io::sha256(scene.scene().resolved);
  }

  bool run_points() {
    for (StudyPoint& point : report_.points) {
      say(point, "error");
      scenes_.push_back(StudyScene::load(session_, point));
      if (!scenes_.back()) return false;
      scenes_.back()->run(point);
      if (watch_.interrupted()) return false;
    }
    return true;
  }

  /// Runs of all points in random order, so that a slow minute of the machine meets them alike.
  bool time_points() {
    std::vector<std::uint32_t> repeats(report_.points.size(), 1);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < report_.points.size(); ++i) {
      StudyPoint& point = report_.points[i];
      if (!point.has_result()) continue;
      if (!time_point(i, 1)) return false;  // warm up, and see how long a run takes
      const double runs = kTimedSeconds / (std::max(point.wall[0], 1e-6) * options_.repetitions);
      repeats[i] = static_cast<std::uint32_t>(std::clamp(std::ceil(runs), 1.0, 1000.0));
      point.wall.clear();
      point.cpu_over_wall = 1;
      order.insert(order.end(), options_.repetitions, i);
    }
    std::mt19937 random(1);
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order)
      if (!time_point(i, repeats[i])) return false;
    return true;
  }

  bool time_point(std::size_t i, std::uint32_t count) {
    StudyPoint& point = report_.points[i];
    say(point, "timing");
    if (!scenes_[i]->time(point, count)) {
      session_.diagnostics.report(
          {.kind = DiagnosticKind::Usage,
           .message = fmt::format("two runs of {} at {} s ended in different states", point.method,
                                  point.dt)});
      return false;
    }
    return !watch_.interrupted();
  }

  /// On a terminal only.
  void say(const StudyPoint& point, const char* what) const {
    if (&session_.err != &std::cerr || isatty(STDERR_FILENO) == 0) return;
    session_.err << fmt::format("\r{} {} {}\x1b[K", what, point.method,
                                point.adaptive ? point.rtol : point.dt)
                 << std::flush;
  }

  void write() {
    std::error_code error;
    std::filesystem::create_directories(options_.folder, error);
    const auto csv = options_.folder / "study.csv", json = options_.folder / "study.json";
    if (io::write_file(csv, study_csv(report_), session_.diagnostics) &&
        io::write_file(json, study_json(report_), session_.diagnostics))
      session_.out << fmt::format("wrote {} and {}\n", csv.string(), json.string());
  }

  Session& session_;
  const StudyOptions& options_;
  const InterruptWatch watch_;
  StudyReport report_;
  std::vector<std::unique_ptr<StudyScene>> scenes_;
};

}  // namespace

int run_study(Session& session) { return StudyJob(session).run(); }

}  // namespace gmsim::cli
