// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "engine/matcher.h"
#include "stdlib/block_state.h"

namespace gmsim::test {

/// Evaluates one interaction on the whole mesh by the tree evaluator: where it matches, its energy,
/// and its forces as minus the centred differences of the energy plus what the file gives by itself.
/// Slow, and independent of the engine's derivatives.
class SpringRun {
 public:
  /// Matches and parameters are those of the state now: parameters keep their values afterwards.
  SpringRun(BlockState& block, const std::string& interaction, const YAML::Node& parameters,
            const YAML::Node& where);

  [[nodiscard]] std::size_t match_count() const { return matches_.size(); }
  [[nodiscard]] double energy();
  /// Force on the vertex of a dart.
  [[nodiscard]] std::array<double, 3> force(types::DartId vertex);
  /// Values of a criterion `of` the interaction, one for each match.
  [[nodiscard]] std::vector<double> criterion(const std::string& name);

 private:
  struct Found {
    types::DartId dart;
    engine::Arguments parameters;
  };
  void find_matches(const YAML::Node& parameters, const YAML::Node& where);
  void store_parameters();
  [[nodiscard]] engine::Arguments parameters_at(types::DartId dart, const YAML::Node& given);
  /// Runs `visit` with nodes, parameters and lets in place.
  template <class Visit>
  void at_match(const Found& found, std::uint32_t frame_size,
                const std::vector<check::Step>& steps, Visit&& visit);
  [[nodiscard]] bool available(const types::Expr& expr) const;
  [[nodiscard]] std::vector<double> evaluate(const types::Expr& expr, engine::Frame& frame);
  void add_explicit(const Found& found, types::DartId vertex, std::array<double, 3>& force);

  BlockState& block_;
  const check::Interaction& item_;
  compile::MatchPlan plan_;
  engine::Matcher matcher_;
  std::vector<Found> matches_;
  std::vector<types::Slot> skipped_;  ///< lets with derivatives, which the evaluator has not
};

}  // namespace gmsim::test
