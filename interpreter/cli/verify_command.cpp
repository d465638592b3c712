// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/json_text.h"
#include "cli/run_cli.h"
#include "cli/scene_session.h"
#include "compile/expression_search.h"
#include "engine/force_probe.h"
#include "engine/tree_eval.h"

namespace gmsim::cli {
namespace {

using scene::Expectation;

/// An expectation and what came of it.
struct Verdict {
  const Expectation* expectation = nullptr;
  bool reached = false;
  std::vector<double> value;  ///< as many numbers as its type has
  double difference = 0;      ///< largest of them, or by how much a bound is missed
  bool met = false;
};

std::string numbers(std::span<const double> values) {
  if (values.size() == 1) return fmt::format("{:.9g}", values[0]);
  return fmt::format("({:.6g})", fmt::join(values, ", "));
}

/// "0.5 +- 1e-06", "at least 3"
std::string wanted(const Expectation& expectation) {
  std::vector<std::string> parts;
  if (expectation.counts_tears) return numbers(expectation.equals);
  if (!expectation.equals.empty())
    parts.push_back(fmt::format("{} +- {:.3g}", numbers(expectation.equals), expectation.within));
  if (expectation.at_least) parts.push_back(fmt::format("at least {:.9g}", *expectation.at_least));
  if (expectation.at_most) parts.push_back(fmt::format("at most {:.9g}", *expectation.at_most));
  return fmt::format("{}", fmt::join(parts, ", "));
}

void judge(Verdict& verdict) {
  const Expectation& wanted = *verdict.expectation;
  verdict.reached = true;
  verdict.met = true;
  const auto demand = [&](double missed_by, double allowed) {
    verdict.difference = std::max(verdict.difference, missed_by);
    verdict.met = verdict.met && missed_by <= allowed;  // not a number: not met
  };
  for (std::size_t k = 0; k < wanted.equals.size(); ++k)
    demand(std::abs(verdict.value[k] - wanted.equals[k]), wanted.within);
  if (wanted.at_least) demand(std::max(0.0, *wanted.at_least - verdict.value[0]), 0);
  if (wanted.at_most) demand(std::max(0.0, verdict.value[0] - *wanted.at_most), 0);
  if (!std::isfinite(verdict.value[0])) verdict.met = false;
}

/// Runs a scene up to its last expectation; steps end at the time of each.
class VerifyJob {
 public:
  explicit VerifyJob(Session& session) : session_(session) {}

  int run() {
    if (!load()) return session_.finish();
    const InterruptWatch watch;
    bool going = evaluate_due();
    while (going && next_time() < kNever) {
      const auto step = simulation_->step(
          std::min(next_time(), next_stop(*scene_, simulation_->time())), session_.diagnostics);
      if (step) tears_ += step->events.size();
      going = step && evaluate_due();
      if (watch.interrupted()) return interrupted();
    }
    session_.finish();
    if (session_.options.run.json) print_json();
    else print_table();
    return going && failed() == 0 ? kDone : kStopped;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  bool load() {
    scene_ = load_scene(session_);
    if (!scene_) return false;
    if (scene_->expectations.empty())
      session_.diagnostics.report(
          {.kind = support::DiagnosticKind::Usage,
           .message = fmt::format("{} expects nothing", scene_->path.string()),
           .help = "say what must come out, as in `expect: [ { value: \"position.z\", point: 0, at: "
                   "end, equals: -0.5, within: 1e-6 } ]`"});
    for (const Expectation& expectation : scene_->expectations)
      verdicts_.push_back({&expectation, false, {}, 0, false});
    if (!session_.diagnostics.has_errors()) simulation_ = make_simulation(session_, *scene_);
    if (!simulation_) return false;
    const bool reads_forces =
        std::ranges::any_of(scene_->expectations, [&](const Expectation& expectation) {
          return expectation.value.value &&
                 compile::reads_forces(*expectation.value.value, scene_->program.schema);
        });
    if (reads_forces)
      probe_ = engine::ForceProbe::create(*scene_->state, scene_->model, session_.diagnostics);
    return !reads_forces || probe_;
  }

  [[nodiscard]] double next_time() const {
    double time = kNever;
    for (const Verdict& verdict : verdicts_)
      if (!verdict.reached) time = std::min(time, verdict.expectation->at);
    return time;
  }

  bool evaluate_due() {
    if (next_time() > simulation_->time()) return true;
    simulation_->sync();
    engine::TreeEvaluator evaluator(*scene_->state);
    if (probe_) {
      if (!probe_->update(session_.diagnostics)) return false;
      evaluator.read_forces(&probe_->forces());
    }
    for (Verdict& verdict : verdicts_)
      if (!verdict.reached && verdict.expectation->at <= simulation_->time() &&
          !evaluate(evaluator, verdict))
        return false;
    return true;
  }

  bool evaluate(engine::TreeEvaluator& evaluator, Verdict& verdict) {
    const Expectation& about = *verdict.expectation;
    if (about.counts_tears) {
      verdict.value = {static_cast<double>(tears_)};
      judge(verdict);
      return true;
    }
    engine::Frame frame(about.value.frame_size);
    frame.set(about.value.dart, about.dart);
    verdict.value.resize(types::component_count(about.value.value->type));
    if (!evaluator.evaluate(*about.value.value, frame, verdict.value)) {
      session_.diagnostics.report(evaluator.take_failure().diagnostic);
      return false;
    }
    judge(verdict);
    return true;
  }

  int interrupted() {
    session_.finish();
    session_.err << fmt::format("interrupted at t = {:.6g} s; nothing is decided\n",
                                simulation_->time());
    return kInterrupted;
  }

  [[nodiscard]] std::size_t failed() const {
    return static_cast<std::size_t>(std::count_if(
        verdicts_.begin(), verdicts_.end(), [](const Verdict& verdict) { return !verdict.met; }));
  }

  void print_table() const {
    std::vector<std::array<std::string, 6>> rows = {
        {"value", "at", "expected", "got", "difference", ""}};
    for (const Verdict& verdict : verdicts_) {
      const Expectation& about = *verdict.expectation;
      const std::string at = fmt::format("{:.6g} s", about.at);
      if (verdict.reached)
        rows.push_back({about.text, at, wanted(about), numbers(verdict.value),
                        fmt::format("{:.3g}", verdict.difference), verdict.met ? "pass" : "FAIL"});
      else
        rows.push_back({about.text, at, wanted(about), "not reached", "", "FAIL"});
    }
    print_columns(rows);
    session_.out << fmt::format("{}: {} of {} met\n", scene_->path.string(),
                                verdicts_.size() - failed(), verdicts_.size());
  }

  void print_columns(const std::vector<std::array<std::string, 6>>& rows) const {
    std::array<std::size_t, 6> widths{};
    for (const auto& row : rows)
      for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
    for (const auto& row : rows) {
      std::string line;
      for (std::size_t k = 0; k < row.size(); ++k)
        line += fmt::format("{:<{}}  ", row[k], widths[k]);
      session_.out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
    }
  }

  void print_json() const {
    JsonArray list;
    for (const Verdict& verdict : verdicts_) {
      const Expectation& about = *verdict.expectation;
      JsonObject object;
      object.add("value", about.text).add("at", about.at).add("met", verdict.met);
      object.add("reached", verdict.reached).add("got", std::span(verdict.value));
      object.add("equals", std::span(about.equals)).add("within", about.within);
      if (about.at_least) object.add("at_least", *about.at_least);
      if (about.at_most) object.add("at_most", *about.at_most);
      list.add_text(object.add("difference", verdict.difference).text());
    }
    session_.out << JsonObject()
                        .add("scene", scene_->path.string())
                        .add("met", verdicts_.size() - failed())
                        .add("failed", failed())
                        .add("steps", simulation_->steps())
                        .add("evaluations", simulation_->evaluations())
                        .add_text("expectations", list.text())
                        .text()
                 << '\n';
  }

  Session& session_;
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<engine::Simulation> simulation_;
  std::unique_ptr<engine::ForceProbe> probe_;  // when an expectation reads forces
  std::vector<Verdict> verdicts_;
  std::uint64_t tears_ = 0;  ///< changes of `tear` so far
};

}  // namespace

int run_verify(Session& session) { return VerifyJob(session).run(); }

}  // namespace gmsim::cli
