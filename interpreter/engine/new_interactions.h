// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/model.h"
#include "engine/rewrite.h"

namespace gmsim::engine {

/// Gives new orbits the interactions that a scene asks for where they are, with their parameters: the
/// rule's own values, else the scene's expressions, else the defaults, evaluated on the new map.
class NewInteractions {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  NewInteractions(State& state, const Model& model);

  /// For Rewriter::on_created().
  Diagnostic carry(Rewriter& rewriter, EmbeddingId presence, DartId smallest);

 private:
  /// Is there a match that starts from this dart? It is in frame_ then.
  bool matches(const compile::RootedPattern& pattern, DartId dart, Diagnostic& error);
  bool asks_for(const InteractionSite& site, const compile::RootedPattern& pattern,
                std::span<const DartId> orbit, Diagnostic& error);
  bool start_match(const compile::RootedPattern& pattern, std::span<const DartId> orbit,
                   DartId& start, Diagnostic& error);
  Diagnostic give(Rewriter& rewriter, const ActiveInteraction& active, const InteractionSite& site,
                  DartId start);
  Diagnostic evaluate(const compile::InteractionBody& body, std::size_t parameter,
                      const InteractionSite& site, DartId start, std::vector<double>& value);
  [[nodiscard]] std::optional<std::uint32_t> body_of(DartId dart) const;

  State& state_;
  const Model& model_;
  Matcher matcher_;
  Frame frame_;
  Match match_;
};

/// Gives the frame the `let`s of an item that an expression reads. False after a failure, which the
/// evaluator keeps.
bool define_lets(const compile::ItemBody& body, const types::Expr& expr, TreeEvaluator& evaluator,
                 Frame& frame);

}  // namespace gmsim::engine
