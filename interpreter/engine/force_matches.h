// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compile/specialise.h"
#include "engine/force_context.h"
#include "engine/force_inputs.h"
#include "engine/matcher.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// One match of an interaction at work.
struct ForceMatch {
  DartId key = gmap::kNoDart;  ///< smallest dart of its orbit: its place in the canonical order
  std::uint32_t shape = 0;
  std::vector<DartId> nodes;   ///< of the pattern, as in ItemBody::nodes
  compile::MatchRoles roles;
  std::vector<double> own;     ///< numbers that the match knows itself (ShapeInputs::own)
};

/// Finds the matches of one interaction at work, one for each orbit that carries it and on which the
/// pattern holds, and sorts them into shapes.
class ForceMatches {
 public:
  using Visit = std::function<void(const ForceMatch&)>;

  ForceMatches(const ForceContext& context, std::uint32_t number);
  /// The matches of any item. Everything given must outlive this.
  ForceMatches(const ForceContext& context, const compile::RootedPattern& pattern,
               const compile::World& world, const compile::ItemBody& body, compile::Wanted wanted,
               const compile::ValueSources& sources);

  /// Who wants to know of orbits on which the pattern holds, but a condition or a missing value stands
  /// against it: matches without shape.
  void on_excluded(Visit visit) { excluded_ = std::move(visit); }
  /// All matches, ascending by key. Stops at the first error and returns it.
  std::optional<support::Diagnostic> find_all(const Visit& visit);
  /// The match of the orbit that holds this dart, if there is one.
  std::optional<support::Diagnostic> find_at(DartId dart, const Visit& visit);

  [[nodiscard]] const compile::ShapeSet& shapes() const { return shapes_; }
  [[nodiscard]] compile::ShapeSet& shapes() { return shapes_; }
  /// ShapeInputs::read_own.
  std::optional<support::Diagnostic> read_own(std::uint32_t shape,
                                              std::span<const compile::Role> roles,
                                              std::vector<double>& out) {
    return inputs_[shape]->read_own(reader_, roles, out);
  }
  [[nodiscard]] const ShapeInputs& inputs(std::uint32_t shape) const { return *inputs_[shape]; }

 private:
  using Diagnostic = std::optional<support::Diagnostic>;

  /// Looks at `orbit_`, whose darts ascend.
  Diagnostic find_in_orbit(const Visit& visit);
  [[nodiscard]] bool carries(DartId d) const;
  /// The dart of `orbit_` at which the pattern holds, kNoDart when there is none.
  Diagnostic choose_dart(DartId& chosen);
  Diagnostic enter(const Visit& visit);

  const ForceContext& context_;
  const compile::RootedPattern& pattern_;
  compile::ShapeSet shapes_;
  std::vector<std::unique_ptr<ShapeInputs>> inputs_;
  Matcher matcher_;
  TreeEvaluator reader_;
  std::vector<bool> first_;  // by dart: chosen by `first`, never decided again while it lives
  std::vector<DartId> orbit_;
  Frame frame_;
  Match found_;
  ForceMatch match_;
  Visit excluded_;
};

}  // namespace gmsim::engine
