// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/dart_expression.h"
#include "engine/state.h"
#include "support/span.h"

/// When what breaks: the `tear:` and `rewrite:` lists of a scene. Plain data.
namespace gmsim::engine {

/// A parameter of a rule, an operation or a criterion: an expression at the dart at hand.
struct SlotValue {
  Slot slot{};
  DartExpression value;
};

/// The rule or the operation that a scene names.
struct NamedChange {
  bool operation = false;
  std::uint32_t target = 0;  ///< index into Program::rules (one hook) or Program::operations
};

/// `{ when: CRITERION, threshold: …, do: CHANGE, … }`.
struct TearPairing {
  std::uint32_t criterion = 0;             ///< index into Program::criteria
  std::vector<SlotValue> parameters;       ///< of the criterion, `threshold` too
  Slot threshold{};                        ///< which of them that is
  NamedChange change;
  /// A parameter of the change: a result of the criterion, or an expression of the scene.
  struct Argument {
    Slot slot{};
    std::optional<std::uint32_t> result;   ///< index into CriterionBody::results
    DartExpression value;                  ///< without `result`
  };
  std::vector<Argument> arguments;
  std::optional<DartExpression> where;     ///< may it tear here? bool, at the hook
  std::vector<std::uint32_t> at;           ///< nodes of the criterion's pattern that the change is applied to
  std::optional<std::uint32_t> at_most;    ///< a step, and whatever ties with the last of them
  double after = 0;                        ///< s
  bool refresh = false;                    ///< strongest first, judged again after each change
  support::Span span;
};

/// `{ apply: CHANGE, to: ORBIT, every: step, … }`.
struct StandingRewrite {
  NamedChange change;
  types::OrbitType to;
  std::optional<DartExpression> where;
  std::vector<SlotValue> parameters;
  support::Span span;
};

/// What happens to the hold of a vertex that is split.
enum class OnSplit : std::uint8_t {
  Both,       ///< all parts are held
  KeepFirst,  ///< the part with the oldest dart
  Release     ///< none
};

}  // namespace gmsim::engine
