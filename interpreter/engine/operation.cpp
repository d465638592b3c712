// SPDX-License-Identifier: MIT
#include "engine/operation.h"

#include "engine/dart_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace gmsim::engine {

using Status = RewriteOutcome::Status;
using support::DiagnosticKind;

namespace {

/// One run of an operation with the operations it applies.
class Run {
 public:
  explicit Run(Rewriter& rewriter)
      : rewriter_(rewriter), state_(rewriter.state()), evaluator_(rewriter.matcher().evaluator()) {}

  RewriteOutcome outcome;

  /// Runs all or nothing; true when it applied.
  bool whole(const compile::Operation& item, DartId dart, const Arguments& arguments) {
    outcome.status = Status::Applied;
    outcome.effects.clear();
    if (!state_.map.alive(dart)) return absent(item, dart);
    const bool alone = !rewriter_.recording();
    if (alone) rewriter_.begin();
    if (operation(item, dart, arguments)) {
      if (alone) rewriter_.commit();
      return true;
    }
    if (alone) rewriter_.roll_back();
    depth_ = 0;
    outcome.effects.clear();
    outcome.error->notes.push_back(
        fmt::format("running operation `{}` at dart {}", item.name, types::index(dart)));
    return false;
  }

 private:
  bool operation(const compile::Operation& item, DartId dart, const Arguments& arguments) {
    constexpr std::size_t kDeepest = 100;
    if (++depth_ > kDeepest) {
      return fail({DiagnosticKind::RecursiveDefinition,
                   fmt::format("operation `{}` applies itself without end", item.name),
                   item.name_span});
    }
    if (frames_.size() < depth_) frames_.emplace_back();
    Frame& frame = frames_[depth_ - 1];
    frame.reset(item.frame_size);
    frame.set(item.dart, dart);
    for (const auto& [slot, value] : arguments) frame.set(slot, value);
    if (!parameters(item, frame) || !block(item.body, frame)) return false;
    --depth_;
    return true;
  }

  bool parameters(const compile::Operation& item, Frame& frame) {
    for (const compile::Parameter& parameter : item.parameters) {
      if (frame.has(parameter.slot)) continue;
      if (!parameter.default_value) {
        return fail({DiagnosticKind::ArgumentCount,
                     fmt::format("parameter `{}` of `{}` has no value", parameter.name, item.name),
                     parameter.span});
      }
      if (!evaluator_.assign(*parameter.default_value, parameter.slot, frame)) return no_value();
    }
    return true;
  }

  bool block(const std::vector<compile::Statement>& body, Frame& frame) {
    return std::all_of(body.begin(), body.end(), [&](const compile::Statement& statement) {
      return std::visit([&](const auto& node) { return run(statement, node, frame); },
                        statement.node);
    });
  }

  bool run(const compile::Statement&, const compile::LetStatement& let, Frame& frame) {
    return evaluator_.assign(*let.value, let.slot, frame) || no_value();
  }

  bool run(const compile::Statement& statement, const compile::AssignStatement& assign,
           Frame& frame) {
    if (!state_.store.in_use(assign.embedding)) return true;
    DartId dart;
    std::vector<double> value(state_.store.column(assign.embedding).stride());
    if (!evaluator_.evaluate_dart(*assign.dart, frame, dart)) return no_value();
    if (!evaluator_.evaluate(*assign.value, frame, value)) return no_value();
    if (!state_.map.alive(dart)) return gone(statement, dart);
    const gmap::EmbeddingDecl& decl = state_.program.schema[assign.embedding];
    if (!std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); })) {
      return fail({DiagnosticKind::NonFinite,
                   fmt::format("non-finite value of `{}`: {}", decl.name,
                               types::to_string(types::Value{decl.type, value})),
                   assign.value->span});
    }
    rewriter_.set_value(assign.embedding, dart, value);
    ++outcome.effects.written_values;
    outcome.effects.written.push_back({decl.orbit, dart});
    return true;
  }

  bool run(const compile::Statement&, const compile::ForStatement& loop, Frame& frame) {
    if (loop.collection->type.kind == types::ValueKind::Range) return range(loop, frame);
    const DartPool::Lease chosen(pool_);
    if (!evaluator_.evaluate_darts(*loop.collection, frame, *chosen)) return no_value();
    std::size_t count = 0;
    for (DartId d : *chosen) {
      bool holds = false;
      frame.set(loop.variable, d);
      if (!condition(loop, frame, holds)) return false;
      if (holds) (*chosen)[count++] = d;
    }
    chosen->resize(count);
    for (DartId d : *chosen) {
      if (!state_.map.alive(d)) continue;
      frame.set(loop.variable, d);
      if (!pass(loop, frame)) return false;
    }
    return true;
  }

  bool range(const compile::ForStatement& loop, Frame& frame) {
    double bounds[2];
    if (!evaluator_.evaluate(*loop.collection, frame, bounds)) return no_value();
    for (double i = bounds[0]; i < bounds[1]; i += 1.0) {
      frame.set(loop.variable, std::span<const double>(&i, 1));
      if (!pass(loop, frame)) return false;
    }
    return true;
  }

  /// An earlier pass may have changed what this one was chosen for.
  bool pass(const compile::ForStatement& loop, Frame& frame) {
    bool holds = false;
    if (!condition(loop, frame, holds)) return false;
    return !holds || block(loop.body, frame);
  }

  bool condition(const compile::ForStatement& loop, Frame& frame, bool& holds) {
    holds = true;
    return !loop.condition || test(*loop.condition, frame, holds);
  }

  /// A condition on an optional value that is missing is false.
  bool test(const types::Expr& expr, Frame& frame, bool& holds) {
    if (evaluator_.evaluate_bool(expr, frame, holds)) return true;
    EvalFailure failure = evaluator_.take_failure();
    holds = false;
    return failure.missing_optional || fail(std::move(failure.diagnostic));
  }

  bool run(const compile::Statement&, const compile::IfStatement& branch, Frame& frame) {
    bool holds = false;
    if (!test(*branch.condition, frame, holds)) return false;
    return block(holds ? branch.then_body : branch.else_body, frame);
  }

  bool run(const compile::Statement& statement, const compile::ApplyStatement& apply,
           Frame& frame) {
    const DartPool::Lease darts(pool_);
    for (const types::ExprPtr& expr : apply.darts) {
      DartId dart;
      if (!evaluator_.evaluate_dart(*expr, frame, dart)) return no_value();
      darts->push_back(dart);
    }
    Arguments arguments;
    for (const auto& [slot, expr] : apply.parameters) {
      std::optional<types::Value> value = evaluator_.evaluate(*expr, frame);
      if (!value) return no_value();
      arguments.emplace_back(slot, std::move(*value));
    }
    if (!apply.operation) {
      return rule(statement, state_.program.rules[apply.target], *darts, arguments);
    }
    if (!state_.map.alive(darts->front())) return gone(statement, darts->front());
    return operation(state_.program.operations[apply.target], darts->front(), arguments);
  }

  bool rule(const compile::Statement& statement, const compile::Rule& item,
            const std::vector<DartId>& hooks, const Arguments& arguments) {
    rewriter_.apply(item, hooks, arguments, outcome);
    if (outcome.applied()) return true;
    if (outcome.status == Status::NotMatched) {
      outcome.error = not_matched(item, hooks, outcome.failure);
      outcome.error->related.push_back({statement.span, "applied here"});
    }
    return false;
  }

  bool absent(const compile::Operation& item, DartId dart) {
    return refuse({DiagnosticKind::NoMatch,
                   fmt::format("dart {} is not part of the map", types::index(dart)),
                   item.name_span});
  }
  bool gone(const compile::Statement& statement, DartId dart) {
    return refuse({DiagnosticKind::NoMatch,
                   fmt::format("dart {} is no longer part of the map", types::index(dart)),
                   statement.span});
  }
  bool refuse(support::Diagnostic diagnostic) {
    outcome.failure = {MatchFailure::Reason::DeadHook};
    outcome.status = Status::NotMatched;
    outcome.error = std::move(diagnostic);
    return false;
  }

  bool no_value() {
    EvalFailure failure = evaluator_.take_failure();
    if (failure.missing_optional) outcome.failure.reason = MatchFailure::Reason::Missing;
    fail(std::move(failure.diagnostic));
    if (failure.missing_optional) outcome.status = Status::NotMatched;
    return false;
  }

  bool fail(support::Diagnostic diagnostic) {
    outcome.status = Status::Failed;
    outcome.error = std::move(diagnostic);
    return false;
  }

  Rewriter& rewriter_;
  State& state_;
  TreeEvaluator& evaluator_;
  std::deque<Frame> frames_;  // of the operations that are running, outermost first
  std::size_t depth_ = 0;
  DartPool pool_;
};

}  // namespace

RewriteOutcome OperationRunner::run(const compile::Operation& operation, DartId dart,
                                    const Arguments& arguments) {
  Run run(rewriter_);
  run.whole(operation, dart, arguments);
  return std::move(run.outcome);
}

RewriteOutcome OperationRunner::run_each(const compile::Operation& operation,
                                         std::span<const DartId> darts,
                                         const Arguments& arguments) {
  Run run(rewriter_);
  Effects all;
  for (DartId dart : darts) {
    if (run.whole(operation, dart, arguments)) {
      all.append(run.outcome.effects);
    } else if (run.outcome.status == Status::Failed) {
      break;
    } else {
      ++all.dropped;
    }
  }
  if (run.outcome.status != Status::Failed) run.outcome = {};
  run.outcome.effects = std::move(all);
  return std::move(run.outcome);
}

}  // namespace gmsim::engine
