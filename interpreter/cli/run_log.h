// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include "engine/simulation.h"
#include "scene/scene.h"

namespace gmsim::cli {

/// How a run ended.
enum class RunEnding {
  Finished,
  Interrupted,  ///< Ctrl-C or SIGTERM
  TimeIsUp,     ///< --max-wall
  Stopped,      ///< the model: unstable, no value, …
  WriteFailed
};
/// "finished", as it stands in the file; interruptions of both kinds are one word there.
[[nodiscard]] const char* name_of(RunEnding ending);

/// Where a run stands.
struct RunProgress {
  double time = 0, duration = 0;   ///< s, simulated
  std::uint64_t steps = 0;
  double wall = 0;                 ///< s, since the first step
  double max_elongation = 1;
  std::int64_t frames = 0;
};

struct RunSummary {
  RunProgress progress;
  RunEnding ending = RunEnding::Finished;
  std::uint64_t evaluations = 0;
  std::uint64_t state_hash = 0;
  std::string file;                ///< empty: nothing was written
  // Of scenes that change their map.
  std::uint64_t tears = 0;         ///< changes that criteria asked for
  std::uint64_t dropped = 0;       ///< asked for, but their place had changed by then
  std::optional<std::size_t> parts = std::nullopt;  ///< connected pieces at the end
};

/// What a run says about itself.
class RunLog {
 public:
  virtual ~RunLog() = default;
  virtual void start(const scene::Scene& scene, const engine::Simulation& simulation) = 0;
  /// A frame is safe.
  virtual void frame(double time, std::uint64_t step, std::int64_t number) = 0;
  /// Called after every step; `progress` is asked for only when something is shown.
  virtual bool wants_progress() = 0;
  virtual void progress(const RunProgress& progress) = 0;
  /// Makes room for messages.
  virtual void clear() = 0;
  virtual void end(const RunSummary& summary) = 0;
};

/// Sentences on `out`, and a line on `err` that is drawn again and again if that is a terminal.
[[nodiscard]] std::unique_ptr<RunLog> make_text_log(std::ostream& out, std::ostream& err);
/// A JSON object a line on `out`: "start", "frame", "progress" (once a second), "end".
[[nodiscard]] std::unique_ptr<RunLog> make_json_log(std::ostream& out);

/// "3:05", "1:02:03"
[[nodiscard]] std::string clock_text(double seconds);
/// The line of a terminal, at most `width` characters.
[[nodiscard]] std::string progress_line(const RunProgress& progress, std::size_t width);

}  // namespace gmsim::cli
