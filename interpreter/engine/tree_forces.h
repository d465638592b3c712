// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "engine/force_context.h"
#include "engine/force_field.h"
#include "engine/force_matches.h"
#include "engine/force_program.h"
#include "engine/ir_evaluate.h"

namespace gmsim::engine {

/// One interaction at work: its matches, evaluated one at a time.
class TreeInteraction {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  TreeInteraction(const ForceContext& context, std::uint32_t number);
  /// Finds all matches anew.
  Diagnostic rebuild();

  /// One thing to compute of every match of a shape. The evaluator refers to the program.
  struct Evaluation {
    explicit Evaluation(ForceProgram of) : program(std::move(of)), evaluator(program.graph) {}
    Evaluation(const Evaluation&) = delete;
    Evaluation& operator=(const Evaluation&) = delete;
    ForceProgram program;
    IrEvaluator<double> evaluator;
  };
  /// The programs of a shape.
  struct Programs {
    Programs(const compile::Shape& shape, const ShapeInputs& inputs);
    Evaluation force, energy, product, direction;
  };
  void run(Evaluation& evaluation, const ForceMatch& match, const ForceMoment& moment) const;

  [[nodiscard]] const std::vector<ForceMatch>& matches() const { return matches_; }
  [[nodiscard]] Programs& programs(const ForceMatch& match) { return *programs_[match.shape]; }
  [[nodiscard]] const std::vector<std::unique_ptr<Programs>>& all_programs() const {
    return programs_;
  }
  [[nodiscard]] const compile::Shape& shape(const ForceMatch& match) const {
    return finder_.shapes()[match.shape];
  }
  [[nodiscard]] const compile::InteractionBody& body() const { return context_.body(number_); }
  [[nodiscard]] std::uint32_t number() const { return number_; }

 private:
  const ForceContext& context_;
  std::uint32_t number_;
  ForceMatches finder_;
  std::vector<ForceMatch> matches_;
  std::vector<std::unique_ptr<Programs>> programs_;  // by shape
};

}  // namespace gmsim::engine
