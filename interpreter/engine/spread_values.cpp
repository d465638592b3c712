// SPDX-License-Identifier: MIT
#include "engine/spread_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gmsim::engine {

using gmap::EmbeddingKind;
using gmap::MergePolicy;
using gmap::OrbitChange;
using support::DiagnosticKind;

namespace {

std::string text(const gmap::EmbeddingDecl& decl, std::span<const double> value) {
  return types::to_string(types::Value{decl.type, {value.begin(), value.end()}});
}

bool all_finite(std::span<const double> value) {
  return std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

void ChangedOrbits::forget(gmap::OrbitRepair& done) const {
  done.orbits.resize(before.orbits);
  done.sources.resize(before.sources);
  done.removed.resize(before.removed);
  done.created = before.created;
  done.split = before.split;
  done.merged = before.merged;
  done.visited_darts = before.visited_darts;
}

std::optional<support::Diagnostic> ValueSpreader::run(std::span<const ChangedOrbits> changed,
                                                      std::span<const AssignedValue> assigned,
                                                      std::span<const double> numbers,
                                                      const compile::ItemHead& rule,
                                                      gmap::Journal* journal, Effects& effects) {
  list_columns();
  assigned_ = assigned;
  numbers_ = numbers;
  rule_ = &rule;
  journal_ = journal;
  effects_ = &effects;
  error_.reset();
  for (const Column& column : columns_) {
    if (column.values->row_end() < column.index->row_end()) {
      column.values->resize(column.index->row_end(), journal);
    }
    spread(column, find(column, changed));
    if (error_) break;
  }
  return std::move(error_);
}

bool ValueSpreader::may_fail(const compile::Rule& rule) {
  list_columns();
  if (judged_rule_ != &rule) {
    judged_rule_ = &rule;
    judged_ = std::any_of(columns_.begin(), columns_.end(),
                          [&](const Column& column) { return may_fail(rule, column); });
  }
  return judged_;
}

bool ValueSpreader::may_fail(const compile::Rule& rule, const Column& column) const {
  const gmap::EmbeddingDecl& decl = state_.program.schema[column.id];
  const compile::RewritePlan& plan = rule.rewrite;
  std::size_t values = 0;  // that may meet in one orbit
  for (const compile::Assignment& assignment : plan.assignments) {
    if (assignment.embedding != column.id) continue;
    values += assignment.joined.size() == rule.match.positions ? 1 : 2;
  }
  if (values > 1) return true;
  if (!plan.affects(decl.orbit)) return false;
  const bool must_agree = decl.merge == MergePolicy::None || decl.merge == MergePolicy::Equal;
  if (decl.kind == EmbeddingKind::Extensive ? decl.weight != nullptr
                                            : must_agree && decl.orbit.meets(plan.made_links)) {
    return true;
  }
  const bool lacks = std::find(plan.unassigned.begin(), plan.unassigned.end(), column.id) !=
                     plan.unassigned.end();
  return lacks && !decl.default_value && !decl.optional;
}

void ValueSpreader::list_columns() {
  if (listed_ == state_.store.column_count()) return;
  judged_rule_ = nullptr;
  columns_.clear();
  for (EmbeddingId id : state_.store.embeddings()) {
    columns_.push_back({id, &state_.store.column(id), &state_.store.index_of(id)});
  }
  std::stable_partition(columns_.begin(), columns_.end(), [&](const Column& column) {
    return state_.program.schema[column.id].kind != EmbeddingKind::Extensive;
  });
  listed_ = state_.store.column_count();
}

const ChangedOrbits* ValueSpreader::find(const Column& column,
                                         std::span<const ChangedOrbits> changed) const {
  const auto found =
      std::find_if(changed.begin(), changed.end(),
                   [&](const ChangedOrbits& entry) { return entry.index == column.index; });
  return found == changed.end() ? nullptr : &*found;
}

void ValueSpreader::spread(const Column& column, const ChangedOrbits* changed) {
  list_assigned(column);
  if (error_) return;
  if (changed != nullptr) {
    if (state_.program.schema[column.id].kind == EmbeddingKind::Extensive) {
      spread_extensive(column, *changed);
    } else {
      spread_intensive(column, *changed);
    }
    store_computed(column);
  }
  store_assigned(column);
  if (changed != nullptr) clear_removed(column, *changed);
}

// ---- assigned values ----------------------------------------------------------------------------

void ValueSpreader::next_epoch(Row row_end) {
  if (assigned_rows_.size() < row_end) assigned_rows_.resize(row_end);
  if (source_rows_.size() < row_end) source_rows_.resize(row_end);
  if (++epoch_ != 0) return;
  std::fill(assigned_rows_.begin(), assigned_rows_.end(), Stamp{});
  std::fill(source_rows_.begin(), source_rows_.end(), Stamp{});
  epoch_ = 1;
}

void ValueSpreader::list_assigned(const Column& column) {
  own_.clear();
  own_rows_.clear();
  for (std::uint32_t i = 0; i < assigned_.size(); ++i) {
    if (assigned_[i].assignment->embedding != column.id) continue;
    own_.push_back(i);
    own_rows_.push_back(column.index->row(assigned_[i].dart));
  }
  if (own_.size() > kFewAssigned) return stamp_assigned(column);
  for (std::size_t k = 1; k < own_.size(); ++k) {
    for (std::size_t j = k; j-- > 0;) {  // the last one before it, as stamps tell
      if (own_rows_[j] != own_rows_[k]) continue;
      check_agreement(own_[j], own_[k], column.values->stride());
      break;
    }
  }
}

void ValueSpreader::stamp_assigned(const Column& column) {
  next_epoch(column.index->row_end());
  for (std::size_t k = 0; k < own_.size(); ++k) {
    Stamp& stamp = assigned_rows_[own_rows_[k]];
    if (stamp.epoch == epoch_) check_agreement(stamp.number, own_[k], column.values->stride());
    stamp = {epoch_, own_[k]};
  }
}

bool ValueSpreader::is_assigned(Row row) const {
  if (own_.size() > kFewAssigned) return assigned_rows_[row].epoch == epoch_;
  return std::find(own_rows_.begin(), own_rows_.end(), row) != own_rows_.end();
}

/// E7: two assignments, or one at two matches, may reach one orbit only with equal values.
void ValueSpreader::check_agreement(std::uint32_t earlier, std::uint32_t later,
                                    std::uint32_t stride) {
  const AssignedValue &first = assigned_[earlier], &second = assigned_[later];
  const auto a = numbers_.subspan(first.begin, stride), b = numbers_.subspan(second.begin, stride);
  if (std::equal(a.begin(), a.end(), b.begin())) return;
  const gmap::EmbeddingDecl& decl = state_.program.schema[second.assignment->embedding];
  support::Diagnostic diagnostic{
      DiagnosticKind::ConflictingValues,
      fmt::format("`{}` of one {} orbit is given two values: {} and {}", decl.name,
                  types::to_string(decl.orbit), text(decl, a), text(decl, b)),
      second.assignment->span};
  if (first.assignment != second.assignment) {
    diagnostic.related.push_back({first.assignment->span, "the other assignment"});
  }
  diagnostic.notes.push_back(fmt::format("the orbit holds dart {} and dart {}",
                                         types::index(first.dart), types::index(second.dart)));
  fail(std::move(diagnostic));
}

void ValueSpreader::store_assigned(const Column& column) {
  for (std::size_t k = 0; k < own_.size(); ++k) {
    write(column, own_rows_[k],
          numbers_.subspan(assigned_[own_[k]].begin, column.values->stride()));
    effects_->written.push_back({column.index->type(), assigned_[own_[k]].dart});
  }
}

// ---- intensive ----------------------------------------------------------------------------------

void ValueSpreader::spread_intensive(const Column& column, const ChangedOrbits& changed) {
  pending_.clear();
  computed_.clear();
  // Parts of a split take rows that no orbit had, so copying to them hides nothing from the merges.
  for (const OrbitChange& orbit : changed.orbits()) {
    if (is_assigned(orbit.row)) continue;
    const std::span<const Row> sources = changed.repair->sources_of(orbit);
    if (sources.empty()) {
      give_default(column, orbit);
    } else if (sources.size() > 1) {
      merge(column, orbit, sources);
    } else if (sources.front() != orbit.row) {
      column.values->copy(sources.front(), orbit.row, journal_);
      ++effects_->written_values;
    }
  }
}

void ValueSpreader::merge(const Column& column, const OrbitChange& orbit,
                          std::span<const Row> sources) {
  const gmap::EmbeddingColumn& values = *column.values;
  valued_.clear();
  for (const Row row : sources) {
    if (values.has(row)) valued_.push_back(row);
  }
  if (valued_.empty()) return;
  // The row that the orbit keeps comes first: that of its smallest dart.
  const auto kept = std::find(valued_.begin(), valued_.end(), orbit.row);
  if (kept != valued_.end()) std::rotate(valued_.begin(), kept, kept + 1);
  pending_.push_back({orbit.row, computed_.size()});
  const auto first = values.get(valued_.front());
  computed_.insert(computed_.end(), first.begin(), first.end());
  const bool agree = std::all_of(valued_.begin(), valued_.end(), [&](Row row) {
    return std::equal(first.begin(), first.end(), values.get(row).begin());
  });
  if (agree) return;
  if (merge_by_policy(column, std::span(computed_).last(values.stride()))) return;
  const gmap::EmbeddingDecl& decl = state_.program.schema[column.id];
  const auto other = std::find_if(valued_.begin(), valued_.end(), [&](Row row) {
    return !std::equal(first.begin(), first.end(), values.get(row).begin());
  });
  support::Diagnostic diagnostic{
      DiagnosticKind::ConflictingValues,
      fmt::format("`{}` joins {} orbits whose `{}` differs: {} and {}", rule_->name,
                  types::to_string(decl.orbit), decl.name, text(decl, first),
                  text(decl, values.get(*other))),
      rule_->name_span};
  diagnostic.related.push_back({decl.span, "declared here"});
  diagnostic.help = fmt::format("assign `{}` in the rule, or declare it with `merge mean`, `first`, "
                                "`min` or `max`", decl.name);
  fail(std::move(diagnostic));
}

/// Combines the values of `valued_`, of which `out` holds the first, component by component. False
/// when the policy has no answer for different values.
bool ValueSpreader::merge_by_policy(const Column& column, std::span<double> out) {
  const MergePolicy policy = state_.program.schema[column.id].merge;
  if (policy == MergePolicy::None || policy == MergePolicy::Equal) return false;
  if (policy == MergePolicy::First) return true;
  if (policy == MergePolicy::Mean) {  // in order of the rows, whichever is kept
    std::sort(valued_.begin(), valued_.end());
    std::copy_n(column.values->get(valued_.front()).begin(), out.size(), out.begin());
  }
  for (std::size_t k = 1; k < valued_.size(); ++k) {
    const auto value = column.values->get(valued_[k]);
    for (std::size_t i = 0; i < out.size(); ++i) {
      switch (policy) {
        case MergePolicy::Min:
          out[i] = std::min(out[i], value[i]);
          break;
        case MergePolicy::Max:
          out[i] = std::max(out[i], value[i]);
          break;
        default:
          out[i] += value[i];
      }
    }
  }
  if (policy == MergePolicy::Mean) {
    for (double& x : out) x /= static_cast<double>(valued_.size());
  }
  return true;
}

// ---- extensive ----------------------------------------------------------------------------------

void ValueSpreader::spread_extensive(const Column& column, const ChangedOrbits& changed) {
  pending_.clear();
  computed_.clear();
  const std::span<const OrbitChange> orbits = changed.orbits();
  const bool same = std::all_of(orbits.begin(), orbits.end(), [&](const OrbitChange& orbit) {
    const auto sources = changed.repair->sources_of(orbit);
    return sources.empty() || (sources.size() == 1 && sources.front() == orbit.row);
  });
  if (!same) weigh_parts(column, changed);
  for (std::size_t k = 0; k < orbits.size() && !error_; ++k) {
    const OrbitChange& orbit = orbits[k];
    if (is_assigned(orbit.row)) continue;
    const auto sources = changed.repair->sources_of(orbit);
    if (sources.empty()) {
      give_default(column, orbit);
    } else if (!same) {
      const std::size_t begin = computed_.size();
      computed_.resize(begin + column.values->stride(), 0.0);
      bool valued = false;
      for (const Row source : sources) {
        valued = add_share(column, source, weights_[k], std::span(computed_).subspan(begin)) ||
                 valued;
      }
      if (valued) {
        pending_.push_back({orbit.row, begin});
      } else {
        computed_.resize(begin);
      }
    }
  }
}

/// Counts the parts of every source and adds up their weights.
void ValueSpreader::weigh_parts(const Column& column, const ChangedOrbits& changed) {
  if (own_.size() <= kFewAssigned) next_epoch(column.index->row_end());
  const std::span<const OrbitChange> orbits = changed.orbits();
  totals_.clear();
  parts_.clear();
  for (const OrbitChange& orbit : orbits) {
    for (const Row source : changed.repair->sources_of(orbit)) {
      Stamp& stamp = source_rows_[source];
      if (stamp.epoch != epoch_) {
        stamp = {epoch_, static_cast<std::uint32_t>(parts_.size())};
        parts_.push_back(0);
        totals_.push_back(0.0);
      }
      ++parts_[stamp.number];
    }
  }
  weights_.assign(orbits.size(), 1.0);
  const bool weighted = state_.program.schema[column.id].weight != nullptr;
  for (std::size_t k = 0; k < orbits.size() && !error_; ++k) {
    const auto sources = changed.repair->sources_of(orbits[k]);
    const bool shares = std::any_of(sources.begin(), sources.end(), [&](Row source) {
      return parts_[source_rows_[source].number] > 1;
    });
    if (weighted && shares) weights_[k] = weight(column, orbits[k].smallest);
    for (const Row source : sources) totals_[source_rows_[source].number] += weights_[k];
  }
}

double ValueSpreader::weight(const Column& column, DartId smallest) {
  const gmap::EmbeddingDecl& decl = state_.program.schema[column.id];
  frame_.reset(decl.frame_size);
  frame_.set(decl.dart_slot, smallest);
  double result = 0.0;
  if (!evaluator_.evaluate(*decl.weight, frame_, {&result, 1})) {
    fail(evaluator_.take_failure().diagnostic);
  } else if (!(result >= 0.0) || !std::isfinite(result)) {
    fail({DiagnosticKind::NonFinite,
          fmt::format("the weight of a part of `{}` is {}", decl.name, types::number_text(result)),
          decl.weight->span,
          {},
          {},
          "weights must be numbers from 0 up"});
  }
  return result;
}

/// Adds a part's share of the value of `source`; false when the source has no value.
bool ValueSpreader::add_share(const Column& column, Row source, double weight,
                              std::span<double> out) {
  if (!column.values->has(source)) return false;
  const auto value = column.values->get(source);
  const std::uint32_t number = source_rows_[source].number;
  if (parts_[number] == 1) {
    std::transform(out.begin(), out.end(), value.begin(), out.begin(), std::plus<>());
    return true;
  }
  const bool zero = std::all_of(value.begin(), value.end(), [](double x) { return x == 0.0; });
  if (zero) return true;
  const double total = totals_[number];
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += value[i] * weight / total;
  if (all_finite(out)) return true;
  const gmap::EmbeddingDecl& decl = state_.program.schema[column.id];
  fail({DiagnosticKind::NonFinite,
        fmt::format("`{}` cannot be shared out: the weights of the parts add up to {}", decl.name,
                    types::number_text(total)),
        decl.weight ? decl.weight->span : decl.span});
  return true;
}

// ---- writing ------------------------------------------------------------------------------------

void ValueSpreader::store_computed(const Column& column) {
  if (error_) return;
  for (const Pending& pending : pending_) {
    write(column, pending.row,
          std::span(computed_).subspan(pending.begin, column.values->stride()));
  }
}

void ValueSpreader::give_default(const Column& column, const OrbitChange& orbit) {
  const gmap::EmbeddingDecl& decl = state_.program.schema[column.id];
  if (decl.default_value) return write(column, orbit.row, decl.default_value->data);
  if (decl.optional) return;
  support::Diagnostic diagnostic{
      DiagnosticKind::MissingValue,
      fmt::format("`{}` creates a {} orbit without a value of `{}`", rule_->name,
                  types::to_string(decl.orbit), decl.name),
      rule_->name_span};
  diagnostic.help = fmt::format("assign `{}` to a node of it, or declare a default", decl.name);
  fail(std::move(diagnostic));
}

/// Rows of orbits that are gone hold nothing.
void ValueSpreader::clear_removed(const Column& column, const ChangedOrbits& changed) {
  for (const Row row : changed.removed()) {
    if (column.values->has(row)) column.values->clear(row, journal_);
  }
}

void ValueSpreader::write(const Column& column, Row row, std::span<const double> value) {
  column.values->set(row, value, journal_);
  ++effects_->written_values;
}

void ValueSpreader::fail(support::Diagnostic diagnostic) {
  if (!error_) error_ = std::move(diagnostic);
}

}  // namespace gmsim::engine
