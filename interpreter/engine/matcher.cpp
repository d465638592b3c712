// SPDX-License-Identifier: MIT
#include "engine/matcher.h"

#include <fmt/format.h>

#include <algorithm>

namespace gmsim::engine {

using compile::Column;
using compile::LinkStep;
using compile::Predicate;
using Reason = MatchFailure::Reason;

Matcher::Matcher(const State& state, MatcherKind kind)
    : state_(state), kind_(kind), evaluator_(state) {}

bool Matcher::fail(Reason reason, std::uint32_t index) {
  failure_.reason = reason;
  failure_.index = index;
  return false;
}

bool Matcher::match(const Plan& plan, std::span<const DartId> hooks, Frame& frame, Match& out) {
  failure_.reason = Reason::None;
  failure_.error.reset();
  if (kind_ == MatcherKind::Naive) {
    return match_naively(state_, plan, hooks, evaluator_, frame, out, failure_);
  }
  std::uint32_t next = 0;
  if (!start(plan, hooks, frame, out)) return false;
  for (std::uint32_t i = 0; i < plan.links.size(); ++i) {
    if (!judge(plan, i, next, frame)) return false;
    const LinkStep& link = plan.links[i];
    if (!step(link, out.darts.data())) return fail(Reason::Link, link.arc);
    if (link.kind == LinkStep::Kind::Follow || link.kind == LinkStep::Kind::FollowPath) {
      frame.set(plan.nodes[link.to].slot, out.darts[link.to]);
    }
  }
  if (!judge(plan, static_cast<std::uint32_t>(plan.links.size()), next, frame)) return false;
  if (plan.positions > 0) {
    const bool grown = plan.positions <= 2 ? grow_linear(plan, out) : grow_breadth_first(plan, out);
    if (!grown || !follow_rows(plan, out) || !labels_hold(plan, out)) return false;
  }
  return distinct(plan, out) && judge(plan, Predicate::kWholeMatch, next, frame);
}

bool Matcher::start(const Plan& plan, std::span<const DartId> hooks, Frame& frame, Match& out) {
  if (hooks.size() != plan.hooks.size()) return fail(Reason::HookCount);
  out.rows = 1;
  out.width = plan.width;
  out.positions = plan.positions;
  out.darts.assign(plan.width, types::kNoDart);
  out.next.assign(plan.positions, 0);
  for (std::size_t k = 0; k < hooks.size(); ++k) {
    if (!state_.map.alive(hooks[k])) return fail(Reason::DeadHook, static_cast<std::uint32_t>(k));
    out.darts[plan.hooks[k]] = hooks[k];
    frame.set(plan.nodes[plan.hooks[k]].slot, hooks[k]);
  }
  return true;
}

bool Matcher::step(const LinkStep& step, DartId* row) {
  DartId end = row[step.from];
  switch (step.kind) {
    case LinkStep::Kind::Follow:
      row[step.to] = state_.map.alpha(step.dimension, end);
      return row[step.to] != end;  // named nodes are different darts
    case LinkStep::Kind::RequireLink:
    case LinkStep::Kind::RequireFree:
      return state_.map.alpha(step.dimension, end) == row[step.to];
    case LinkStep::Kind::FollowPath:
      for (std::int8_t i : step.path) end = state_.map.alpha(i, end);
      row[step.to] = end;
      return true;
    case LinkStep::Kind::RequirePath:
      for (std::int8_t i : step.path) end = state_.map.alpha(i, end);
      return end == row[step.to];
  }
  return false;
}

bool Matcher::follow_rows(const Plan& plan, Match& out) {
  for (std::uint32_t row = 1; row < out.rows; ++row) {
    DartId* darts = out.darts.data() + std::size_t{row} * out.width;
    for (const LinkStep& link : plan.links) {
      if (!step(link, darts)) return fail(Reason::Link, link.arc);
    }
  }
  return true;
}

bool Matcher::judge(const Plan& plan, std::uint32_t links, std::uint32_t& next, Frame& frame) {
  for (; next < plan.predicates.size() && plan.predicates[next].after <= links; ++next) {
    if (!judge_predicate(plan.predicates[next], next, evaluator_, frame, failure_)) return false;
  }
  return true;
}

bool judge_predicate(const Predicate& predicate, std::uint32_t index, TreeEvaluator& evaluator,
                     Frame& frame, MatchFailure& failure) {
  bool holds = true;
  bool defined = true;
  switch (predicate.kind) {
    case Predicate::Kind::Parameter:
      defined = frame.has(predicate.slot) ||
                evaluator.assign(*predicate.value, predicate.slot, frame);
      break;
    case Predicate::Kind::Let:
      defined = evaluator.assign(*predicate.value, predicate.slot, frame);
      break;
    case Predicate::Kind::Where:
      defined = evaluator.evaluate_bool(*predicate.value, frame, holds);
      break;
  }
  if (defined && holds) return true;
  failure.index = index;
  failure.reason = Reason::Where;
  if (defined) return false;
  EvalFailure why = evaluator.take_failure();
  failure.reason = why.missing_optional ? Reason::Missing : Reason::Error;
  failure.error = std::move(why.diagnostic);
  return false;
}

// ---- rows ---------------------------------------------------------------------------------------

void Matcher::lead(const Plan& plan, const Match& match, std::uint32_t row,
                   std::uint32_t position) {
  images_.resize(plan.hooks.size());
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Column hook = plan.hooks[k];
    images_[k] = state_.map.alpha(plan.nodes[hook].label[position], match.dart(row, hook));
  }
}

bool Matcher::images_are(const Plan& plan, const Match& match, std::uint32_t row) const {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    if (images_[k] != match.dart(row, plan.hooks[k])) return false;
  }
  return true;
}

std::uint32_t Matcher::add_row(const Plan& plan, Match& out) const {
  out.darts.resize(out.darts.size() + out.width, types::kNoDart);
  out.next.resize(out.next.size() + out.positions, 0);
  DartId* darts = out.darts.data() + std::size_t{out.rows} * out.width;
  for (std::size_t k = 0; k < images_.size(); ++k) darts[plan.hooks[k]] = images_[k];
  return out.rows++;
}

bool Matcher::grow_linear(const Plan& plan, Match& out) {
  list_path(plan, out);
  const Column hook = plan.hooks.front();
  for (std::uint32_t row = 0; row < out.rows; ++row) {
    out.darts[std::size_t{row} * out.width + hook] = images_[row];
  }
  for (std::size_t k = 1; k < plan.hooks.size(); ++k) {
    if (!follow_path(plan, plan.hooks[k], out)) return fail(Reason::HookLabels);
  }
  return true;
}

/// Walks from the first hook along position 0, then 1, and so on; unless that closes, from there
/// along position 1 as well. Its darts go into `images_`, the rows into `out`.
void Matcher::list_path(const Plan& plan, Match& out) {
  const Column hook = plan.hooks.front();
  const DartId begin = out.darts[hook];
  const DartId* alpha[2];
  for (std::uint32_t p = 0; p < plan.positions; ++p) {
    alpha[p] = state_.map.alphas(plan.nodes[hook].label[p]).data();
  }
  images_.assign(1, begin);
  if (plan.positions == 1) {
    const DartId end = alpha[0][types::index(begin)];
    if (end != begin) images_.push_back(end);
    make_rows(out);
    out.next.front() = out.rows - 1;  // back from there the row is 0
    return;
  }
  const auto walk = [&](std::uint32_t position) {
    for (DartId d = begin;; position = 1 - position) {
      const DartId to = alpha[position][types::index(d)];
      if (to == d) return false;
      if (to == begin) return true;
      images_.push_back(d = to);
    }
  };
  const bool closed = walk(0);
  const auto first = static_cast<std::uint32_t>(images_.size());
  if (!closed) walk(1);
  make_rows(out);
  std::uint32_t* const next = out.next.data();
  const auto chain = [&](std::uint32_t row, std::uint32_t position, std::uint32_t end) {
    for (std::uint32_t last = 0; row < end; last = row++, position = 1 - position) {
      next[2 * last + position] = row;
      next[2 * row + position] = last;
    }
  };
  const auto end_row = [&](std::uint32_t row, std::uint32_t position, std::uint32_t to) {
    next[2 * row + position] = to;
    next[2 * to + position] = row;
  };
  chain(1, 0, first);
  end_row(first - 1, (first - 1) % 2, closed ? 0 : first - 1);
  if (closed) return;
  chain(first, 1, out.rows);
  const std::uint32_t last = out.rows == first ? 0 : out.rows - 1;
  end_row(last, (out.rows - first + 1) % 2, last);
}

/// A row for each of the images, whose darts and neighbours are still to come.
void Matcher::make_rows(Match& out) const {
  out.rows = static_cast<std::uint32_t>(images_.size());
  out.darts.resize(std::size_t{out.rows} * out.width, types::kNoDart);
  out.next.resize(std::size_t{out.rows} * out.positions, 0);
}

/// Gives the rows the darts of another hook, in whose orbit they must be joined in the same way.
bool Matcher::follow_path(const Plan& plan, Column hook, Match& out) const {
  for (std::uint32_t row = 0; row < out.rows; ++row) {
    for (std::uint32_t position = 0; position < plan.positions; ++position) {
      const DartId image =
          state_.map.alpha(plan.nodes[hook].label[position], out.dart(row, hook));
      DartId& to = out.darts[std::size_t{out.next_row(row, position)} * out.width + hook];
      if (to == types::kNoDart) to = image;
      if (to != image) return false;
    }
  }
  return true;
}

bool Matcher::grow_breadth_first(const Plan& plan, Match& out) {
  next_epoch();
  const Column hook = plan.hooks.front();
  stamps_[types::index(out.dart(0, hook))] = {epoch_, 0};
  for (std::uint32_t row = 0; row < out.rows; ++row) {
    for (std::uint32_t position = 0; position < plan.positions; ++position) {
      lead(plan, out, row, position);
      Stamp& stamp = stamps_[types::index(images_.front())];
      if (stamp.epoch != epoch_) stamp = {epoch_, add_row(plan, out)};
      if (!images_are(plan, out, stamp.row)) return fail(Reason::HookLabels);
      out.next[std::size_t{row} * out.positions + position] = stamp.row;
    }
  }
  return true;
}

bool Matcher::labels_hold(const Plan& plan, const Match& match) {
  for (const compile::LabelStep& step : plan.labels) {
    for (std::uint32_t row = 0; row < match.rows; ++row) {
      const DartId image = state_.map.alpha(step.dimension, match.dart(row, step.column));
      if (image != match.dart(match.next_row(row, step.position), step.column)) {
        return fail(Reason::Label, step.column);
      }
    }
  }
  return true;
}

bool Matcher::distinct(const Plan& plan, const Match& match) {
  constexpr std::size_t kFewDarts = 12;  // comparing them is cheaper than marking them
  const auto columns = static_cast<Column>(plan.nodes.size());
  if (columns < 2) return true;  // rows of one hook are different darts
  if (match.rows * columns > kFewDarts) {
    next_epoch();
    for (std::uint32_t row = 0; row < match.rows; ++row) {
      for (Column column = 0; column < columns; ++column) {
        Stamp& stamp = stamps_[types::index(match.dart(row, column))];
        if (stamp.epoch == epoch_) return fail(Reason::NotDistinct, column);
        stamp.epoch = epoch_;
      }
    }
    return true;
  }
  DartId seen[kFewDarts];
  std::size_t count = 0;
  for (std::uint32_t row = 0; row < match.rows; ++row) {
    for (Column column = 0; column < columns; ++column) {
      const DartId d = match.dart(row, column);
      if (std::find(seen, seen + count, d) != seen + count) {
        return fail(Reason::NotDistinct, column);
      }
      seen[count++] = d;
    }
  }
  return true;
}

void Matcher::next_epoch() {
  stamps_.resize(std::max<std::size_t>(stamps_.size(), state_.map.dart_end()));
  if (++epoch_ != 0) return;
  std::fill(stamps_.begin(), stamps_.end(), Stamp{});
  epoch_ = 1;
}

// ---- messages -----------------------------------------------------------------------------------

namespace {

std::string arc_text(const compile::MatchPlan& plan, std::uint32_t index) {
  const compile::PlanArc& arc = plan.arcs[index];
  std::string dimensions;
  for (std::int8_t i : arc.dimensions) {
    dimensions += fmt::format("{}{}", dimensions.empty() ? "" : ".", int{i});
  }
  return fmt::format("{} -{}- {}", plan.nodes[arc.from].name, dimensions, plan.nodes[arc.to].name);
}

}  // namespace

std::string describe(const MatchFailure& failure, const compile::MatchPlan& plan) {
  switch (failure.reason) {
    case Reason::None:
      return "the pattern holds";
    case Reason::HookCount:
      return fmt::format("the rule needs {} darts", plan.hooks.size());
    case Reason::DeadHook:
      return fmt::format("the dart of `{}` is not part of the map",
                         plan.nodes[plan.hooks[failure.index]].name);
    case Reason::Link:
      return fmt::format("there is no link `{}`", arc_text(plan, failure.index));
    case Reason::NotDistinct:
      return fmt::format("`{}` falls on a dart of another node", plan.nodes[failure.index].name);
    case Reason::HookLabels:
      return "the orbits of the hooks differ in shape";
    case Reason::Label:
      return fmt::format("the orbit of `{}` is not that of its label",
                         plan.nodes[failure.index].name);
    case Reason::Where:
      return "a `where` is false";
    case Reason::Missing:
    case Reason::Error:
      return failure.error ? failure.error->message : "an expression has no value";
  }
  return {};
}

}  // namespace gmsim::engine
