// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/dart_expression.h"
#include "engine/state.h"
#include "engine/tear_model.h"
#include "support/span.h"
#include "types/expr.h"
#include "types/value.h"

/// What is simulated: which interactions act, with which parameters, and what moves by decree.
/// Plain data, made by a scene and read by Simulation.
namespace gmsim::engine {

/// How a parameter of an interaction gets its value (language, parameters).
struct ParameterBinding {
  enum class Kind : std::uint8_t {
    Uniform,  ///< the same everywhere and always: folded into the program, no column
    Stored,   ///< one value per orbit in the column of `embedding`, set when the match first exists
    OfTime    ///< reads `time`: evaluated at every stage
  };
  EmbeddingId embedding{};
  Kind kind = Kind::Uniform;
  types::Value uniform;        ///< Uniform; SI
  DartExpression expression;   ///< OfTime
};

/// One place of a scene that asks for an interaction. Where a rule makes a new orbit there on which
/// the pattern holds, that orbit carries it too.
struct InteractionSite {
  std::optional<std::uint32_t> body;
  std::optional<DartExpression> where;
  std::vector<DartExpression> given;  ///< by parameter; without a value: the interaction's default
};

/// An interaction at work. The orbits that carry it are those with its presence mark.
struct ActiveInteraction {
  std::uint32_t interaction = 0;  ///< index into Program::interactions
  std::vector<ParameterBinding> parameters;
  std::vector<InteractionSite> sites;
  support::Span span;             ///< where the scene asks for it
};

/// Vertices whose motion is prescribed: `position` as a function of time, or `velocity`, which is
/// integrated from where they are.
struct PrescribedMotion {
  std::vector<DartId> vertices;  ///< one dart of each
  bool gives_position = false;
  DartExpression expression;     ///< vec3, m or m/s
  support::Span span;
};

/// A fixed vertex that does not simply stay fixed in all its parts when it is split.
struct Hold {
  DartId vertex = gmap::kNoDart;
  OnSplit on_split = OnSplit::Both;
};

/// Vertices with the embedding `fixed` do not move at all.
struct Model {
  std::vector<ActiveInteraction> interactions;
  std::vector<PrescribedMotion> motions;
  std::vector<TearPairing> tears;
  std::vector<StandingRewrite> rewrites;
  std::vector<Hold> holds;
  /// Of the darts at the start; empty when there is one body. What rules make belongs to the body
  /// that it hangs together with.
  std::vector<std::uint32_t> body_of_dart;
};

/// What happens when the step is above the stability limit.
enum class OnUnstable : std::uint8_t { Error, Warn, Substep };

struct IntegratorSettings {
  std::string method = "rk4";   ///< a row of integrators.def
  double dt = 0;                ///< s; 0: automatic, from the stability bound
  OnUnstable on_unstable = OnUnstable::Error;
  double rtol = 1e-6;           ///< adaptive methods
  double atol_position = 0;     ///< m; 0: the shortest edge times rtol
  double atol_velocity = 0;     ///< m/s; 0: atol_position times the highest frequency
  double dt_min = 0;            ///< s
  double dt_max = 0;            ///< s; 0: no limit
  std::optional<support::Span> span = std::nullopt;  ///< where the scene asks for it
};

}  // namespace gmsim::engine
