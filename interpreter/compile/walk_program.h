// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/specialise.h"
#include "compile/symbolic_value.h"

namespace gmsim::compile {

/// A straight way to the roles of a match: walks from its nodes, tests that they lead to a match of
/// the same shape, and the orbits read at their ends. Possible when the shape rests on links and
/// coincidences alone; then no expression need be looked at to enter a match into its table.
class WalkProgram {
 public:
  struct Step {
    std::uint32_t from = 0;  ///< earlier step, or node
    std::uint8_t dimension = 0;
  };
  struct Test {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    bool same = true;  ///< the walks end at one dart, or at different ones
  };
  struct Visit {
    OrbitType type;
    std::uint32_t walk = 0;
    std::uint32_t role = 0;
    const gmap::OrbitIndex* index = nullptr;
  };
  /// The embedding must have a value at the role's orbit.
  struct Presence {
    EmbeddingId embedding{};
    std::uint32_t role = 0;
  };

  std::uint32_t nodes = 0;  ///< walks 0 .. nodes-1 are the match's nodes, step k is walk nodes + k
  std::vector<Step> steps;
  std::vector<Test> tests;
  std::vector<Visit> visits;  ///< in order of first appearance, each orbit and walk once
  std::vector<Presence> presences;
  std::vector<std::uint32_t> targets;  ///< walks to the darts of the force targets

  /// Fills roles and targets. False: the match has another shape, or lacks a value.
  bool run(const World& world, std::span<const DartId> node_darts, MatchRoles& out);
  /// The darts that the last run came by, its nodes first.
  [[nodiscard]] const std::vector<DartId>& darts() const { return darts_; }

 private:
  std::vector<DartId> darts_;
};

/// Records a WalkProgram while a match is walked symbolically. Anything that depends on more than
/// links and coincidences spoils it.
class WalkTrace {
 public:
  void start(std::uint32_t nodes);
  void spoil() { straight_ = false; }
  /// The walk that continues `from` by a link.
  std::uint32_t follow(std::uint32_t from, int dimension);
  /// That two darts were found to be the same or not decides.
  void test(std::uint32_t a, std::uint32_t b, bool same);
  void visit(OrbitType type, std::uint32_t walk, std::uint32_t role,
             const gmap::OrbitIndex* index);
  void require(EmbeddingId embedding, std::uint32_t role);
  void target(std::uint32_t walk);
  [[nodiscard]] std::optional<WalkProgram> take();

 private:
  /// False, and everything is spoilt, when a walk is not known.
  bool known(std::uint32_t walk);

  WalkProgram program_;
  bool straight_ = true;
};

}  // namespace gmsim::compile
