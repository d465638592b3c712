// SPDX-License-Identifier: MIT
#include "engine/operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

  bool operation(const compile::Operation& item, DartId dart, const Arguments& arguments) {
    constexpr int kDeepest = 100;
    if (++depth_ > kDeepest) {
      return fail({DiagnosticKind::RecursiveDefinition,
                   fmt::format("operation `{}` applies itself without end", item.name),
                   item.name_span});
    }
    Frame frame(item.frame_size);
    frame.set(item.dart, dart);
    for (const auto& [slot, value] : arguments) frame.set(slot, value);
    const bool done = parameters(item, frame) && block(item.body, frame);
    --depth_;
    return done;
  }

 private:
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
    return true;
  }

  bool run(const compile::Statement&, const compile::ForStatement& loop, Frame& frame) {
    if (loop.collection->type.kind == types::ValueKind::Range) return range(loop, frame);
    std::vector<DartId> all;
    if (!evaluator_.evaluate_darts(*loop.collection, frame, all)) return no_value();
    std::vector<DartId> chosen;
    for (DartId d : all) {
      bool holds = false;
      frame.set(loop.variable, d);
      if (!condition(loop, frame, holds)) return false;
      if (holds) chosen.push_back(d);
    }
    for (DartId d : chosen) {
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
    std::vector<DartId> darts(apply.darts.size());
    for (std::size_t i = 0; i < darts.size(); ++i) {
      if (!evaluator_.evaluate_dart(*apply.darts[i], frame, darts[i])) return no_value();
    }
    Arguments arguments;
    for (const auto& [slot, expr] : apply.parameters) {
      std::optional<types::Value> value = evaluator_.evaluate(*expr, frame);
      if (!value) return no_value();
      arguments.emplace_back(slot, std::move(*value));
    }
    if (!apply.operation) {
      return rule(statement, state_.program.rules[apply.target], darts, arguments);
    }
    if (!state_.map.alive(darts.front())) return gone(statement, darts.front());
    return operation(state_.program.operations[apply.target], darts.front(), arguments);
  }

  bool rule(const compile::Statement& statement, const compile::Rule& item,
            const std::vector<DartId>& hooks, const Arguments& arguments) {
    RewriteOutcome result = rewriter_.apply(item, hooks, arguments);
    if (result.applied()) {
      outcome.effects.append(result.effects);
      return true;
    }
    outcome.status = result.status;
    outcome.failure = std::move(result.failure);
    outcome.error = std::move(result.error);
    if (outcome.status == Status::NotMatched) {
      outcome.error = not_matched(item, hooks, outcome.failure);
      outcome.error->related.push_back({statement.span, "applied here"});
    }
    return false;
  }

  bool gone(const compile::Statement& statement, DartId dart) {
    outcome.failure.reason = MatchFailure::Reason::DeadHook;
    fail({DiagnosticKind::NoMatch,
          fmt::format("dart {} is no longer part of the map", types::index(dart)),
          statement.span});
    outcome.status = Status::NotMatched;
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
  int depth_ = 0;
};

}  // namespace

RewriteOutcome OperationRunner::run(const compile::Operation& operation, DartId dart,
                                    const Arguments& arguments) {
  Run run(rewriter_);
  if (!rewriter_.state().map.alive(dart)) {
    run.outcome.status = Status::NotMatched;
    run.outcome.failure.reason = MatchFailure::Reason::DeadHook;
    run.outcome.error = support::Diagnostic{
        DiagnosticKind::NoMatch,
        fmt::format("dart {} is not part of the map", types::index(dart)), operation.name_span};
    return std::move(run.outcome);
  }
  const bool alone = !rewriter_.recording();
  if (alone) rewriter_.begin();
  if (run.operation(operation, dart, arguments)) {
    if (alone) rewriter_.commit();
    return std::move(run.outcome);
  }
  if (alone) rewriter_.roll_back();
  run.outcome.effects = {};
  run.outcome.error->notes.push_back(fmt::format("running operation `{}` at dart {}",
                                                 operation.name, types::index(dart)));
  return std::move(run.outcome);
}

RewriteOutcome OperationRunner::run_each(const compile::Operation& operation,
                                         std::span<const DartId> darts,
                                         const Arguments& arguments) {
  RewriteOutcome all;
  for (DartId dart : darts) {
    RewriteOutcome one = run(operation, dart, arguments);
    if (one.status == Status::Failed) {
      one.effects = std::move(all.effects);
      return one;
    }
    if (one.applied()) {
      all.effects.append(one.effects);
    } else {
      ++all.effects.dropped;
    }
  }
  return all;
}

}  // namespace gmsim::engine
