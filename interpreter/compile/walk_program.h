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
/// the same shape, and the orbits read at their ends. Possible when the shape rests on links,
/// coincidences and the order of darts alone, and not on many; then no expression need be looked at
/// to enter a match into its table.
class WalkProgram {
 public:
  struct Step {
    std::uint32_t from = 0;  ///< earlier step, or node
    std::uint8_t dimension = 0;
  };
  struct Test {
    enum class Kind : std::uint8_t { Same, Different, Older };
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Kind kind = Kind::Same;  ///< of the darts at the ends of the walks
  };
  /// That two darts are in one orbit, or are not.
  struct OrbitTest {
    const gmap::OrbitIndex* index = nullptr;
    std::uint32_t a = 0, b = 0;  ///< walks
    bool same = false;
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
  std::vector<OrbitTest> orbit_tests;
  std::vector<Visit> visits;  ///< in order of first appearance, each orbit and walk once
  std::vector<Presence> presences;
  std::vector<std::uint32_t> targets;  ///< walks to the darts of the force targets
  /// So many atomic forces live on sub-orbits of an orbit.
  struct ForceList {
    OrbitType type;
    std::uint32_t walk = 0;
    std::uint32_t count = 0;
  };
  std::vector<ForceList> lists;

  /// Fills roles and targets. False: the match has another shape, or lacks a value.
  bool run(const World& world, std::span<const DartId> node_darts, MatchRoles& out);
  /// What the last run rested on.
  void list_dependences(const World& world, std::vector<Dependence>& out) const;
  /// The roles of a match of this shape on whose walks no link has changed. False: another shape.
  bool find_roles(const World& world, std::span<const DartId> node_darts, std::vector<Role>& roles);

 private:
  void walk(const World& world, std::span<const DartId> node_darts);
  /// Fills roles; false: an orbit test fails, or orbits coincide otherwise.
  bool meet_orbits(std::vector<Role>& roles) const;
  [[nodiscard]] bool holds(const Test& test) const;

  std::vector<DartId> darts_;
};

/// Records a WalkProgram while a match is walked symbolically. Anything that depends on more than
/// links and coincidences spoils it.
class WalkTrace {
 public:
  void start(std::uint32_t nodes, bool record);
  [[nodiscard]] bool straight() const { return straight_; }
  void spoil() { straight_ = false; }
  /// The walk that continues `from` by a link.
  std::uint32_t follow(std::uint32_t from, int dimension);
  /// That two darts were found to be the same or not decides.
  void test(std::uint32_t a, std::uint32_t b, bool same);
  void test_orbit(const gmap::OrbitIndex& index, std::uint32_t a, std::uint32_t b, bool same);
  /// That a dart was found to be older than another decides.
  void older(std::uint32_t a, std::uint32_t b);
  void visit(OrbitType type, std::uint32_t walk, std::uint32_t role,
             const gmap::OrbitIndex* index);
  void require(EmbeddingId embedding, std::uint32_t role);
  void target(std::uint32_t walk);
  void list(OrbitType type, std::uint32_t walk, std::uint32_t count);
  [[nodiscard]] std::optional<WalkProgram> take();

 private:
  /// False, and everything is spoilt, when a walk is not known.
  bool known(std::uint32_t walk);

  WalkProgram program_;
  bool straight_ = true;
};

}  // namespace gmsim::compile
