// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/named_item.h"
#include "cli/run_cli.h"
#include "cli/write_mesh.h"
#include "compile/compile.h"
#include "engine/enumerate.h"
#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/orbit_walk.h"
#include "scene/mesh_spec.h"
#include "scene/mesh_state.h"

namespace gmsim::cli {
namespace {

using check::CheckedExpression;
using engine::DartId;
using engine::State;
using support::DiagnosticKind;
using types::OrbitType;

/// Fatal problems are errors, the others warnings; false when the map was not built.
bool report_problems(const std::vector<gmap::MeshProblem>& problems, Session& session) {
  for (const gmap::MeshProblem& problem : problems)
    session.diagnostics.report({.kind = DiagnosticKind::MeshTopology,
                                .message = problem.message,
                                .severity = problem.fatal ? support::Severity::Error
                                                          : support::Severity::Warning});
  return !session.diagnostics.has_errors();
}

/// Number of cells of each dimension and of connected pieces, for the summary.
std::string count_cells(const gmap::GMap& map) {
  static constexpr const char* kOne[] = {"vertex", "edge", "face", "volume"};
  static constexpr const char* kMany[] = {"vertices", "edges", "faces", "volumes"};
  std::vector<std::string> counts = {fmt::format("{} darts", map.dart_count())};
  for (int i = 0; i <= map.dimension(); ++i) {
    const std::size_t cells = gmap::all_orbits(map, OrbitType::cell(i, map.dimension())).size();
    counts.push_back(fmt::format("{} {}", cells, cells == 1 ? kOne[i] : kMany[i]));
  }
  const std::size_t pieces = gmap::all_orbits(map, OrbitType::range(0, map.dimension())).size();
  counts.push_back(fmt::format("{} piece{}", pieces, pieces == 1 ? "" : "s"));
  return fmt::format("{}", fmt::join(counts, ", "));
}

/// One `gmsim apply` job: a state made from a mesh, and a rule or an operation for it.
class ApplyJob {
 public:
  explicit ApplyJob(Session& session) : session_(session) {}

  int run() {
    if (!load() || !choose()) return session_.finish();
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint32_t pass = 0; pass < session_.options.times; ++pass)
      if (!apply_once()) return stopped();
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    summarise();
    if (!session_.options.output.empty()) write_result();
    return session_.finish();
  }

 private:
  /// What goes wrong while rules are applied is no mistake of the command line or of a file.
  int stopped() {
    const int code = session_.finish();
    return code == kRejected ? kStopped : code;
  }

  bool load() {
    const auto mesh = scene::mesh_from_spec(session_.options.mesh, session_.diagnostics);
    rules_ = session_.check_rules();
    if (!mesh || session_.diagnostics.has_errors()) return false;
    gmap::MeshMap built = gmap::build_map(*mesh);
    if (!report_problems(built.problems, session_)) return false;

    program_ = compile::compile_program(rules_.in(mesh->dimension));
    state_ = std::make_unique<State>(program_, std::move(built.map));
    state_->use_data();
    scene::set_positions(*state_, *mesh, built.dart_point);
    scene::set_corner_masses(*state_, *mesh, built.dart_cell, session_.options.density);
    points_.emplace(vertices(), built.point_dart);
    for (const std::string& name : scene::missing_embeddings(*state_))
      session_.diagnostics.report(
          {.kind = DiagnosticKind::MissingValue,
           .message = fmt::format("the mesh gives no value for the embedding `{}`", name),
           .help = "give it a default in its declaration, or make it `optional`"});
    return !session_.diagnostics.has_errors();
  }

  bool choose() {
    item_ = find_named_item(rules_, program_, session_);
    if (!item_) return false;
    if (!read_arguments(*item_, rules_, *state_, session_, arguments_)) return false;
    if (!session_.options.where.empty() && !read_where()) return false;
    if (!session_.options.to.empty() && !read_to()) return false;
    if (session_.options.at.empty() && item_->hook_count() > 1) return refuse_several_hooks();
    if (item_->operation && session_.options.at.size() > 1) return refuse_several_darts();
    engine::RewriteOptions options;
    options.validate = session_.options.validate;
    if (session_.options.naive_matcher) options.matcher = engine::MatcherKind::Naive;
    rewriter_ = std::make_unique<engine::Rewriter>(*state_, options);
    return true;
  }

  bool refuse_several_hooks() {
    session_.diagnostics.report(
        {.kind = DiagnosticKind::Usage,
         .message = fmt::format("`{}` has {} hooks, so candidates cannot be listed for it",
                                session_.options.rule, item_->hook_count()),
         .help = fmt::format("name one dart for each with `--at`, as in `--at {}`",
                             item_->hook_count() == 2 ? "12,57" : "12,57,…")});
    return false;
  }

  bool refuse_several_darts() {
    session_.diagnostics.report({.kind = DiagnosticKind::Usage,
                                 .message = "an operation is applied at one dart"});
    return false;
  }

  bool read_where() {
    const auto text = session_.sources.add("--where", session_.options.where);
    where_ = check::check_expression(rules_, program_.dimension, text, {types::ValueKind::Bool},
                                     session_.sources, session_.diagnostics);
    return where_.value != nullptr;
  }

  bool read_to() {
    to_ = rules_.in(program_.dimension).find_orbit(session_.options.to);
    if (to_) return true;
    std::vector<std::string> names;
    for (const auto& orbit : rules_.in(program_.dimension).orbits) names.push_back(orbit.name);
    session_.diagnostics.report(
        {.kind = DiagnosticKind::UnknownOrbit,
         .message = fmt::format("no orbit named `{}` in dimension {}", session_.options.to,
                                program_.dimension),
         .help = fmt::format("orbits are {}", fmt::join(names, ", "))});
    return false;
  }

  /// Does `--where` hold at a dart? An expression without a value stops the job.
  bool where_holds(engine::TreeEvaluator& evaluator, DartId dart) {
    engine::Frame frame(where_.frame_size);
    frame.set(where_.dart, dart);
    bool holds = false;
    if (!evaluator.evaluate_bool(*where_.value, frame, holds)) {
      const engine::EvalFailure failure = evaluator.take_failure();
      if (!failure.missing_optional) session_.diagnostics.report(failure.diagnostic);
      return false;
    }
    return holds;
  }

  [[nodiscard]] std::vector<DartId> candidates() {
    engine::TreeEvaluator evaluator(*state_);
    std::vector<DartId> darts;
    for (const DartId dart : gmap::all_orbits(state_->map, to_.value_or(item_->orbit())))
      if (!where_.value || where_holds(evaluator, dart)) darts.push_back(dart);
    return darts;
  }

  bool apply_once() {
    const engine::RewriteOutcome outcome = apply();
    if (outcome.error) session_.diagnostics.report(*outcome.error);
    rules_applied_ += outcome.effects.applications;
    applied_ += session_.options.at.empty() && item_->hook_count() > 0
                    ? tried_ - outcome.effects.dropped
                    : outcome.applied();
    dropped_ += outcome.effects.dropped;
    touched_ += outcome.effects.touched.size();
    visited_ += outcome.effects.visited_darts();
    if (outcome.status == engine::RewriteOutcome::Status::NotMatched)
      session_.diagnostics.report(
          {.kind = DiagnosticKind::NoMatch,
           .message = fmt::format("`{}` does not apply there: {}", session_.options.rule,
                                  item_->describe(outcome.failure))});
    return !session_.diagnostics.has_errors();
  }

  engine::RewriteOutcome apply() {
    if (!session_.options.at.empty()) return apply_at(session_.options.at);
    if (item_->hook_count() == 0) return rewriter_->apply(*item_->rule, {}, arguments_);
    const std::vector<DartId> darts = candidates();
    if (session_.diagnostics.has_errors()) return {};
    tried_ = darts.size();
    candidates_ += tried_;
    if (item_->operation)
      return engine::OperationRunner(*rewriter_).run_each(*item_->operation, darts, arguments_);
    return rewriter_->apply_everywhere(*item_->rule, darts, arguments_);
  }

  engine::RewriteOutcome apply_at(const std::vector<std::uint32_t>& numbers) {
    std::vector<DartId> darts;
    for (const std::uint32_t number : numbers) darts.push_back(DartId{number});
    if (item_->operation)
      return engine::OperationRunner(*rewriter_).run(*item_->operation, darts[0], arguments_);
    return rewriter_->apply(*item_->rule, darts, arguments_);
  }

  const gmap::OrbitIndex& vertices() {
    return state_->store.use_index(OrbitType::cell(0, program_.dimension));
  }

  void write_result() {
    points_->update(vertices());
    write_mesh(*state_, *points_, session_.options.output, session_.diagnostics);
  }

  void summarise() {
    session_.out << fmt::format("{}: applied {} time{}", session_.options.rule, applied_,
                                applied_ == 1 ? "" : "s");
    if (dropped_ > 0) session_.out << fmt::format(", {} candidate{} did not match", dropped_,
                                                   dropped_ == 1 ? "" : "s");
    session_.out << '\n' << count_cells(state_->map) << '\n';
    if (session_.options.profile)
      session_.out << fmt::format(
          "profile: {:.6f} s, {} candidates, {} rules applied, {} touched darts, {} darts visited "
          "for upkeep\n",
          seconds_, candidates_, rules_applied_, touched_, visited_);
  }

  Session& session_;
  check::CheckedRules rules_;
  compile::Program program_;
  std::unique_ptr<State> state_;
  std::unique_ptr<engine::Rewriter> rewriter_;
  std::optional<io::PointNumbering> points_;
  std::optional<NamedItem> item_;
  engine::Arguments arguments_;
  CheckedExpression where_;
  std::optional<OrbitType> to_;
  double seconds_ = 0;
  std::uint64_t tried_ = 0;  ///< candidates of the last pass
  std::uint64_t applied_ = 0, dropped_ = 0, candidates_ = 0, rules_applied_ = 0;
  std::uint64_t touched_ = 0, visited_ = 0;
};

}  // namespace

int run_apply(Session& session) { return ApplyJob(session).run(); }

}  // namespace gmsim::cli
