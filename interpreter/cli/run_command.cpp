// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/explain_tears.h"
#include "cli/frame_clock.h"
#include "cli/interrupt.h"
#include "cli/run_cli.h"
#include "cli/run_log.h"
#include "cli/run_output.h"
#include "cli/scene_session.h"
#include "engine/integrators.h"
#include "gmap/orbit_walk.h"

namespace gmsim::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// One run of a scene, from its file to the file of its frames.
class RunJob {
 public:
  explicit RunJob(Session& session)
      : session_(session),
        options_(session.options.run),
        log_(options_.json ? make_json_log(session.out)
                           : make_text_log(session.out, session.err)) {}

  int run() {
    if (!load()) return session_.finish();
    log_->start(*scene_, *simulation_);
    begin_ = Clock::now();
    report_step(first_report());
    RunEnding ending = write_due_frames(first_report()) ? advance() : failure();
    ending = close(ending);
    const int code = finish(ending);
    summarise(ending);
    return code;
  }

 private:
  bool load() {
    scene_ = load_scene(session_);
    if (!scene_) return false;
    simulation_ = make_simulation(session_, *scene_);
    if (!simulation_) return false;
    const scene::OutputPlan& plan = scene_->output;
    frames_.emplace(simulation_->time(), plan.every, plan.at, scene_->duration);
    reports_.emplace(simulation_->time(), plan.report_every, std::vector<double>{},
                     scene_->duration);
    is_adaptive_ = engine::find_integrator(scene_->integrator.method)->adaptive;
    if (options_.no_output) return !session_.diagnostics.has_errors();
    file_ = output_file();
    output_ = RunOutput::create(*scene_, session_.sources,
                                {file_, session_.options.command_line, options_.force},
                                session_.diagnostics);
    if (output_) session_.print_warnings();
    return output_ != nullptr;
  }

  /// `--out`, else what the scene says, else its name; where the program was started.
  [[nodiscard]] std::filesystem::path output_file() const {
    if (!options_.output.empty()) return options_.output;
    if (!scene_->output.file.empty()) return scene_->output.file;
    return scene_->path.stem().string() + ".vtkhdf";
  }

  [[nodiscard]] engine::StepReport first_report() const {
    engine::StepReport report;
    report.time = simulation_->time();
    report.dt = simulation_->dt();
    return report;
  }

  /// Steps until the end, or until something happens.
  RunEnding advance() {
    const InterruptWatch watch;
    while (simulation_->time() < scene_->duration) {
      const auto step =
          simulation_->step(next_stop(*scene_, simulation_->time()), session_.diagnostics);
      if (!step) return RunEnding::Stopped;
      if (output_) output_->note(*step);
      tears_ += step->events.size();
      dropped_ += step->dropped;
      report_step(*step);
      if (!write_due_frames(*step)) return failure();
      if (watch.interrupted()) return RunEnding::Interrupted;
      if (options_.max_wall && seconds_since(session_.begin) > *options_.max_wall)
        return RunEnding::TimeIsUp;
      if (log_->wants_progress()) log_->progress(progress());
    }
    return RunEnding::Finished;
  }

  /// Why a frame was not written: its file, or a field without a value.
  [[nodiscard]] RunEnding failure() const {
    return session_.diagnostics.all().back().kind == support::DiagnosticKind::FileError
               ? RunEnding::WriteFailed
               : RunEnding::Stopped;
  }

  [[nodiscard]] double slack(const engine::StepReport& step) const { return 1e-6 * step.dt; }

  /// Frames lie at the first step end at or after their time, those of adaptive methods inside the
  /// step.
  bool write_due_frames(const engine::StepReport& step) {
    while (frames_->is_due(step.time, slack(step))) {
      const double due = std::min(frames_->next(), step.time);
      const bool inside = is_adaptive_ && due < step.time - slack(step);
      frames_->pass(inside ? due : step.time, slack(step));
      if (!output_) continue;
      const bool written = inside
                               ? output_->write_frame_at(due, step, *simulation_,
                                                         session_.diagnostics)
                               : output_->write_frame(*simulation_, session_.diagnostics);
      if (!written) return false;
      log_->frame(output_->last_time(), simulation_->steps(), output_->frames() - 1);
    }
    return true;
  }

  /// A row of the time series when its own clock, or that of the frames, says so.
  void report_step(const engine::StepReport& step) {
    const bool with_frames = scene_->output.report_every == 0;
    FrameClock& clock = with_frames ? *frames_ : *reports_;
    if (!clock.is_due(step.time, slack(step))) return;
    if (!with_frames) clock.pass(step.time, slack(step));
    if (!output_) return;
    output_->add_report({step, simulation_->totals(), simulation_->max_elongation()},
                        *simulation_);
  }

  [[nodiscard]] RunProgress progress() const {
    return {simulation_->time(),
            scene_->duration,
            simulation_->steps(),
            seconds_since(begin_),
            simulation_->max_elongation(),
            output_ ? output_->frames() : 0};
  }

  /// Adds the last good state as a frame, and gives the file its name.
  RunEnding close(RunEnding ending) {
    stepping_ = seconds_since(begin_);
    if (!output_ || ending == RunEnding::WriteFailed) return ending;
    const bool is_shown = output_->frames() > 0 && output_->last_time() == simulation_->time();
    if (!is_shown && output_->frames() > 0 &&
        !output_->write_frame(*simulation_, session_.diagnostics))
      return failure();
    return output_->close(simulation_->state_hash(), name_of(ending), session_.diagnostics)
               ? ending
               : RunEnding::WriteFailed;
  }

  int finish(RunEnding ending) {
    log_->clear();
    session_.finish();
    switch (ending) {
      case RunEnding::Finished: return kDone;
      case RunEnding::Interrupted:
      case RunEnding::TimeIsUp: return kInterrupted;
      case RunEnding::Stopped: return kStopped;
      case RunEnding::WriteFailed: return kInputOutput;
    }
    return kInternalError;
  }

  void summarise(RunEnding ending) {
    RunSummary summary{progress(), ending, simulation_->evaluations(), simulation_->state_hash(),
                       {}};
    if (!scene_->model.tears.empty() || !scene_->model.rewrites.empty()) {
      const gmap::GMap& map = scene_->state->map;
      summary.tears = tears_;
      summary.dropped = dropped_;
      summary.parts =
          gmap::all_orbits(map, types::OrbitType::range(0, map.dimension())).size();
    }
    summary.progress.wall = stepping_;
    if (output_)
      summary.file = (ending == RunEnding::WriteFailed ? io::part_path(file_) : file_).string();
    log_->end(summary);
    if (options_.explain_tear && !options_.json)
      explain_tears(*scene_, *simulation_, session_.out, session_.diagnostics);
  }

  Session& session_;
  const RunOptions& options_;
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<engine::Simulation> simulation_;
  std::optional<FrameClock> frames_, reports_;
  std::unique_ptr<RunOutput> output_;
  std::filesystem::path file_;
  Clock::time_point begin_;
  std::uint64_t tears_ = 0, dropped_ = 0;
  double stepping_ = 0;  // s of wall time between the first step and the last
  bool is_adaptive_ = false;
};

}  // namespace

int run_scene(Session& session) { return RunJob(session).run(); }

}  // namespace gmsim::cli
