// SPDX-License-Identifier: MIT
#include "cli/run_log.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "cli/json_text.h"
#include "engine/integrators.h"

namespace gmsim::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// True at most once in a period.
class Throttle {
 public:
  explicit Throttle(double seconds) : period_(seconds), last_(Clock::now()) {}
  bool passes() {
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < period_) return false;
    last_ = now;
    return true;
  }

 private:
  double period_;
  Clock::time_point last_;
};

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::size_t point_count(const scene::Scene& scene) {
  std::size_t count = 0;
  for (const scene::BodySummary& body : scene.bodies) count += body.vertices.size();
  return count;
}

std::size_t cell_count(const scene::Scene& scene) {
  std::size_t count = 0;
  for (const scene::BodySummary& body : scene.bodies) count += body.cells;
  return count;
}

bool is_adaptive(const scene::Scene& scene) {
  const auto* method = engine::find_integrator(scene.integrator.method);
  return method != nullptr && method->adaptive;
}

std::string limit_text(double limit) {
  return std::isfinite(limit) ? fmt::format("{:.4g} s", limit) : "none";
}

std::string step_text(const scene::Scene& scene, const engine::Simulation& simulation) {
  const engine::StabilityLimit& limit = simulation.limit();
  if (is_adaptive(scene))
    return fmt::format("steps from the error (rtol {:.3g}), first {:.4g} s; stability limit {}",
                       scene.integrator.rtol, simulation.dt(), limit_text(limit.dt_global));
  std::string text = fmt::format("dt {:.6g} s{}", simulation.dt(),
                                 scene.integrator.dt > 0 ? "" : " (auto)");
  text += fmt::format(", limit {} (element-wise {})", limit_text(limit.dt_global),
                      limit_text(limit.dt));
  if (std::isfinite(limit.dt_global))
    text += fmt::format(", ratio {:.3g}", simulation.dt() / limit.dt_global);
  return text;
}

const char* sentence(RunEnding ending) {
  switch (ending) {
    case RunEnding::Finished: return "done";
    case RunEnding::Interrupted: return "interrupted";
    case RunEnding::TimeIsUp: return "stopped by --max-wall";
    case RunEnding::Stopped: return "stopped";
    case RunEnding::WriteFailed: return "stopped, because a frame could not be written";
  }
  return "";
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

class TextLog : public RunLog {
 public:
  TextLog(std::ostream& out, std::ostream& err)
      : out_(out), err_(err), shows_(&err == &std::cerr && isatty(STDERR_FILENO) != 0) {}

  void start(const scene::Scene& scene, const engine::Simulation& simulation) override {
    const std::string name = scene.path.stem().string();
    out_ << fmt::format("{}: {}D, {}, {}, {}; {} s with {}\n", name, scene.program.dimension,
                        counted(point_count(scene), "point", "points"),
                        counted(cell_count(scene), "cell", "cells"),
                        counted(scene.model.interactions.size(), "interaction", "interactions"),
                        scene.duration, scene.integrator.method);
    out_ << step_text(scene, simulation) << '\n' << std::flush;
  }
  void frame(double, std::uint64_t, std::int64_t) override {}
  bool wants_progress() override { return shows_ && throttle_.passes(); }
  void progress(const RunProgress& progress) override {
    err_ << '\r' << progress_line(progress, terminal_width() - 1) << "\x1b[K" << std::flush;
    drawn_ = true;
  }
  void clear() override {
    if (drawn_) err_ << "\r\x1b[K" << std::flush;
    drawn_ = false;
  }
  void end(const RunSummary& summary) override {
    clear();
    const RunProgress& at = summary.progress;
    out_ << fmt::format("{}: t = {:.6g} s, {} in {:.3g} s", sentence(summary.ending), at.time,
                        counted(at.steps, "step", "steps"), at.wall);
    if (at.wall > 0)
      out_ << fmt::format(" ({:.4g} steps/s, {:.3g} times real time)",
                          static_cast<double>(at.steps) / at.wall, at.time / at.wall);
    out_ << fmt::format(", max elongation {:.4g}\n", at.max_elongation);
    if (summary.parts)
      out_ << fmt::format("{}, {} dropped; {} at the end\n",
                          counted(summary.tears, "tear", "tears"), summary.dropped,
                          counted(*summary.parts, "part", "parts"));
    if (!summary.file.empty())
      out_ << fmt::format("wrote {}: {}, state {:016x}\n", summary.file,
                          counted(static_cast<std::size_t>(at.frames), "frame", "frames"),
                          summary.state_hash);
    else
      out_ << fmt::format("state {:016x}\n", summary.state_hash);
    out_ << std::flush;
  }

 private:
  std::ostream& out_;
  std::ostream& err_;
  bool shows_;
  bool drawn_ = false;
  Throttle throttle_{0.1};
};

class JsonLog : public RunLog {
 public:
  explicit JsonLog(std::ostream& out) : out_(out) {}

  void start(const scene::Scene& scene, const engine::Simulation& simulation) override {
    const engine::StabilityLimit& limit = simulation.limit();
    print(JsonObject()
              .add("event", "start")
              .add("scene", scene.path.string())
              .add("dimension", scene.program.dimension)
              .add("points", point_count(scene))
              .add("cells", cell_count(scene))
              .add("interactions", scene.model.interactions.size())
              .add("method", scene.integrator.method)
              .add("adaptive", is_adaptive(scene))
              .add("duration", scene.duration)
              .add("dt", simulation.dt())
              .add("limit", limit.dt_global)
              .add("limit_elementwise", limit.dt)
              .add("seed", scene.seed));
  }
  void frame(double time, std::uint64_t step, std::int64_t number) override {
    print(JsonObject().add("event", "frame").add("frame", number).add("time", time).add("step", step));
  }
  bool wants_progress() override { return throttle_.passes(); }
  void progress(const RunProgress& progress) override {
    JsonObject object;
    add_progress(progress, object.add("event", "progress"));
    print(object);
  }
  void clear() override {}
  void end(const RunSummary& summary) override {
    JsonObject object;
    add_progress(summary.progress, object.add("event", "end").add("ending", name_of(summary.ending)));
    object.add("evaluations", summary.evaluations);
    object.add("state_hash", fmt::format("{:016x}", summary.state_hash));
    object.add("file", summary.file);
    print(object);
  }

 private:
  static void add_progress(const RunProgress& progress, JsonObject& object) {
    object.add("time", progress.time).add("duration", progress.duration);
    object.add("step", progress.steps).add("frames", progress.frames);
    object.add("wall", progress.wall).add("max_elongation", progress.max_elongation);
  }
  void print(const JsonObject& object) { out_ << object.text() << '\n' << std::flush; }

  std::ostream& out_;
  Throttle throttle_{1.0};
};

}  // namespace

const char* name_of(RunEnding ending) {
  switch (ending) {
    case RunEnding::Finished: return "finished";
    case RunEnding::Interrupted:
    case RunEnding::TimeIsUp: return "interrupted";
    case RunEnding::Stopped:
    case RunEnding::WriteFailed: return "stopped";
  }
  return "";
}

std::unique_ptr<RunLog> make_text_log(std::ostream& out, std::ostream& err) {
  return std::make_unique<TextLog>(out, err);
}

std::unique_ptr<RunLog> make_json_log(std::ostream& out) {
  return std::make_unique<JsonLog>(out);
}

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds) || seconds > 3.6e8) return "?";
  const auto whole = static_cast<std::int64_t>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(const RunProgress& progress, std::size_t width) {
  const double part =
      progress.duration > 0 ? std::clamp(progress.time / progress.duration, 0.0, 1.0) : 1.0;
  const double left = part > 0 ? progress.wall * (1 - part) / part
                               : std::numeric_limits<double>::infinity();
  const double wall = std::max(progress.wall, 1e-9);
  std::string text = fmt::format(
      "{:5.1f} %  t = {:.4g} s  {:.0f} steps/s  {:.3g}x real time  ETA {}  max elongation {:.3g}",
      100 * part, progress.time, static_cast<double>(progress.steps) / wall, progress.time / wall,
      clock_text(left), progress.max_elongation);
  constexpr std::size_t kBar = 20;
  if (text.size() + kBar + 3 <= width) {
    const auto full = static_cast<std::size_t>(part * kBar);
    text = fmt::format("[{}{}] {}", std::string(full, '#'), std::string(kBar - full, '-'), text);
  }
  return text.substr(0, width);
}

}  // namespace gmsim::cli
