// SPDX-License-Identifier: MIT
#include "engine/rewrite.h"

#include <fmt/format.h>

#include "engine/rewriter_implementation.h"
#include "gmap/validate.h"

namespace gmsim::engine {

using Status = RewriteOutcome::Status;

namespace {

std::string hooks_text(const compile::Rule& rule, std::span<const DartId> hooks) {
  std::string text;
  for (std::size_t k = 0; k < hooks.size(); ++k) {
    const bool named = k < rule.match.hooks.size();
    text += fmt::format("{}{} = dart {}", k == 0 ? "" : ", ",
                        named ? rule.match.nodes[rule.match.hooks[k]].name : "?",
                        types::index(hooks[k]));
  }
  return text;
}

}  // namespace

support::Diagnostic not_matched(const compile::Rule& rule, std::span<const DartId> hooks,
                                const MatchFailure& failure) {
  const std::string where = hooks.empty() ? "" : " at " + hooks_text(rule, hooks);
  support::Diagnostic diagnostic{support::DiagnosticKind::NoMatch,
                                 fmt::format("rule `{}` cannot be applied{}: {}", rule.name, where,
                                             describe(failure, rule.match))};
  switch (failure.reason) {
    case MatchFailure::Reason::Link:
      diagnostic.place = rule.match.arcs[failure.index].span;
      break;
    case MatchFailure::Reason::NotDistinct:
    case MatchFailure::Reason::Label:
      diagnostic.place = rule.match.nodes[failure.index].span;
      break;
    case MatchFailure::Reason::Where:
      diagnostic.place = rule.match.predicates[failure.index].value->span;
      break;
    case MatchFailure::Reason::Missing:
    case MatchFailure::Reason::Error:
      if (failure.error) diagnostic.place = failure.error->place;
      break;
    default:
      diagnostic.place = rule.name_span;
  }
  return diagnostic;
}

// ---- Rewriter -----------------------------------------------------------------------------------

Rewriter::Rewriter(State& state, RewriteOptions options)
    : implementation_(std::make_unique<Implementation>(*this, state, options)) {}
Rewriter::~Rewriter() = default;

RewriteOutcome Rewriter::apply(const compile::Rule& rule, std::span<const DartId> hooks,
                               const Arguments& arguments) {
  RewriteOutcome outcome;
  implementation_->apply(rule, hooks, arguments, outcome);
  return outcome;
}

void Rewriter::apply(const compile::Rule& rule, std::span<const DartId> hooks,
                     const Arguments& arguments, RewriteOutcome& outcome) {
  implementation_->apply(rule, hooks, arguments, outcome);
}

RewriteOutcome Rewriter::apply_each(const compile::Rule& rule, std::span<const DartId> darts,
                                    const Arguments& arguments) {
  RewriteOutcome outcome;
  for (const DartId& dart : darts) {
    implementation_->apply(rule, {&dart, 1}, arguments, outcome);
    if (outcome.status == Status::Failed) return outcome;
    if (outcome.status == Status::NotMatched) ++outcome.effects.dropped;
  }
  outcome.status = Status::Applied;
  outcome.failure = {};
  return outcome;
}

RewriteOutcome Rewriter::apply_everywhere(const compile::Rule& rule,
                                          std::span<const DartId> darts,
                                          const Arguments& arguments) {
  return rule.rewrite.changes.empty() ? apply_at_once(rule, darts, arguments)
                                      : apply_each(rule, darts, arguments);
}

RewriteOutcome Rewriter::apply_at_once(const compile::Rule& rule, std::span<const DartId> darts,
                                       const Arguments& arguments) {
  GMSIM_CHECK(rule.rewrite.changes.empty(), "only rules that change no link apply at once");
  RewriteOutcome outcome;
  for (const DartId dart : darts) {
    if (implementation_->read_at_once(rule, dart, arguments, outcome)) continue;
    if (outcome.status == Status::Failed) {
      outcome.effects = {};
      return outcome;
    }
    ++outcome.effects.dropped;
  }
  outcome.status = Status::Applied;
  outcome.failure = {};
  implementation_->write_at_once(rule, outcome);
  return outcome;
}

void Rewriter::begin() { implementation_->begin(); }
void Rewriter::commit() { implementation_->commit(); }
void Rewriter::roll_back() { implementation_->roll_back(); }
bool Rewriter::recording() const { return implementation_->journal() != nullptr; }

void Rewriter::set_value(EmbeddingId id, DartId dart, std::span<const double> value) {
  implementation_->state.store.set(id, dart, value, implementation_->journal());
}

void Rewriter::on_created(CreatedOrbitHook hook) { implementation_->on_created = std::move(hook); }
State& Rewriter::state() { return implementation_->state; }
Matcher& Rewriter::matcher() { return implementation_->matcher; }

// ---- one application ----------------------------------------------------------------------------

Rewriter::Implementation::Implementation(Rewriter& self, State& object, RewriteOptions options)
    : state(object), matcher(object, options.matcher), self_(self), options_(options),
      spreader_(object, matcher.evaluator()), programs_(object), machine_(object) {}

void Rewriter::Implementation::begin() {
  GMSIM_CHECK(!recording_, "begin() does not nest");
  recording_ = true;
  state.map.set_journal(&journal_);
}

void Rewriter::Implementation::commit() {
  journal_.commit();
  recording_ = false;
  state.map.set_journal(nullptr);
}

void Rewriter::Implementation::roll_back() {
  state.map.set_journal(nullptr);
  journal_.roll_back(state.map, state.store);
  recording_ = false;
}

void Rewriter::Implementation::fail(const compile::Rule& rule, support::Diagnostic diagnostic,
                                    RewriteOutcome& outcome) {
  diagnostic.notes.push_back(fmt::format("applying rule `{}`{}", rule.name,
                                         hooks_.empty() ? "" : " at " + hooks_text(rule, hooks_)));
  outcome.status = Status::Failed;
  outcome.error = std::move(diagnostic);
}

void Rewriter::Implementation::fail_evaluation(const compile::Rule& rule,
                                               RewriteOutcome& outcome) {
  EvalFailure failure = matcher.evaluator().take_failure();
  if (!failure.missing_optional) return fail(rule, std::move(failure.diagnostic), outcome);
  outcome.status = Status::NotMatched;
  outcome.failure = {MatchFailure::Reason::Missing, 0, std::move(failure.diagnostic)};
}

bool Rewriter::Implementation::match(const compile::Rule& rule, std::span<const DartId> hooks,
                                     const Arguments& arguments, RewriteOutcome& outcome) {
  hooks_.assign(hooks.begin(), hooks.end());
  frame_.reset(rule.frame_size);
  for (const auto& [slot, value] : arguments) frame_.set(slot, value);
  for (const compile::Parameter& parameter : rule.parameters) {
    if (parameter.default_value || frame_.has(parameter.slot)) continue;
    fail(rule,
         {support::DiagnosticKind::ArgumentCount,
          fmt::format("parameter `{}` of `{}` has no value", parameter.name, rule.name),
          parameter.span},
         outcome);
    return false;
  }
  if (matcher.match(rule.match, hooks, frame_, match_)) {
    row_plan_ = &row_plans_.find(rule, match_);
    return true;
  }
  outcome.failure = matcher.failure();
  outcome.status = Status::NotMatched;
  if (outcome.failure.reason == MatchFailure::Reason::Error) {
    fail(rule, *outcome.failure.error, outcome);
  }
  return false;
}

void Rewriter::Implementation::apply(const compile::Rule& rule, std::span<const DartId> hooks,
                                     const Arguments& arguments, RewriteOutcome& outcome) {
  assigned_.clear();
  assigned_cells_.clear();
  numbers_.clear();
  if (!match(rule, hooks, arguments, outcome) || !evaluate(rule, outcome)) return;
  const bool alone = !recording_;
  if (alone && may_fail(rule)) begin();
  changed_.clear();
  effects_ = &outcome.effects;
  const Counts before = count_effects();
  change_links(rule.rewrite);
  // Orbits of what is no map cannot be walked.
  Diagnostic error = options_.validate ? report_broken(gmap::validate(state.map)) : std::nullopt;
  if (!error) repair_orbits(rule.rewrite);
  if (!error) error = store_values(rule);
  if (!error && options_.validate) error = report_broken(gmap::validate(state.map, state.store));
  if (error) {
    GMSIM_CHECK(recording_, "a rule failed that cannot: " + error->message);
    forget_effects(before);
    // Within begin() … commit() the caller undoes everything.
    if (alone) roll_back();
    return fail(rule, std::move(*error), outcome);
  }
  if (alone && recording_) commit();
  ++effects_->applications;
  effects_->matched_rows += match_.rows;
  outcome.status = Status::Applied;
}

Rewriter::Implementation::Counts Rewriter::Implementation::count_effects() const {
  return {effects_->touched.size(), effects_->written.size(), effects_->created_darts,
          effects_->removed_darts, effects_->written_values};
}

/// Takes back what the effects say of the rewrite at hand.
void Rewriter::Implementation::forget_effects(const Counts& before) {
  effects_->touched.resize(before.touched);
  effects_->written.resize(before.written);
  effects_->created_darts = before.created_darts;
  effects_->removed_darts = before.removed_darts;
  effects_->written_values = before.written_values;
  for (const ChangedOrbits& changed : changed_) {
    changed.forget(effects_->repair(changed.index->type()));
  }
}

/// Recording for a roll-back costs a fifth of the time, so it is left out where nothing can fail.
bool Rewriter::Implementation::may_fail(const compile::Rule& rule) {
  return options_.validate || on_created || spreader_.may_fail(rule);
}

std::optional<support::Diagnostic> Rewriter::Implementation::store_values(
    const compile::Rule& rule) {
  for (std::size_t i = 0; i < assigned_.size(); ++i) {
    const auto [row, column] = assigned_cells_[i];
    assigned_[i].dart = match_.dart(row, column);
  }
  Diagnostic error = spreader_.run(changed_, assigned_, numbers_, rule, journal(), *effects_);
  return error ? std::move(error) : announce_created();
}

std::optional<support::Diagnostic> Rewriter::Implementation::announce_created() {
  if (!on_created) return std::nullopt;
  for (const ChangedOrbits& changed : changed_) {
    for (EmbeddingId id : state.store.embeddings()) {
      const gmap::EmbeddingDecl& decl = state.program.schema[id];
      if (decl.role != gmap::EmbeddingRole::Presence || decl.orbit != changed.index->type()) {
        continue;
      }
      for (const gmap::OrbitChange& orbit : changed.orbits()) {
        if (orbit.sources_count > 0) continue;
        if (Diagnostic error = on_created(self_, id, orbit.smallest)) return error;
      }
    }
  }
  return std::nullopt;
}

std::optional<support::Diagnostic> Rewriter::Implementation::report_broken(
    const std::vector<std::string>& broken) {
  if (broken.empty()) return std::nullopt;
  support::Diagnostic diagnostic{support::DiagnosticKind::InvalidMap,
                                 "the map is not valid after a rewrite"};
  diagnostic.notes = broken;
  return diagnostic;
}

// ---- rules that change values only, at all matches at once --------------------------------------

bool Rewriter::Implementation::read_at_once(const compile::Rule& rule, DartId hook,
                                            const Arguments& arguments, RewriteOutcome& outcome) {
  if (outcome.effects.applications == 0) {
    assigned_.clear();
    assigned_cells_.clear();
    numbers_.clear();
  }
  const std::size_t values = assigned_.size();
  if (!match(rule, {&hook, 1}, arguments, outcome) || !evaluate(rule, outcome)) {
    assigned_.resize(values);
    assigned_cells_.resize(values);
    return false;
  }
  for (std::size_t i = values; i < assigned_.size(); ++i) {
    assigned_[i].dart = match_.dart(assigned_cells_[i].first, assigned_cells_[i].second);
  }
  ++outcome.effects.applications;
  outcome.effects.matched_rows += match_.rows;
  return true;
}

void Rewriter::Implementation::write_at_once(const compile::Rule& rule, RewriteOutcome& outcome) {
  if (outcome.effects.applications == 0) return;
  const bool alone = !recording_;
  if (alone) begin();
  hooks_.clear();
  Diagnostic error = spreader_.run({}, assigned_, numbers_, rule, &journal_, outcome.effects);
  if (error) {
    if (alone) roll_back();
    return fail(rule, std::move(*error), outcome);
  }
  if (alone) commit();
}

}  // namespace gmsim::engine
