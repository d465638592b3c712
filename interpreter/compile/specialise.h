// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "compile/dependence.h"
#include "compile/interaction_body.h"
#include "compile/ir.h"
#include "compile/value_source.h"
#include "gmap/embedding_store.h"
#include "gmap/gmap.h"
#include "support/diagnostic.h"

/// From an item's checked expressions to arithmetic, at one match: walks, collections, conditions
/// on links and whole numbers are decided on the map; what is left is an ir::Graph whose inputs
/// are gathered from orbits. Matches that take the same decisions have the same graph: a *shape*.
namespace gmsim::compile {

using gmap::DartId;
using gmap::Row;

/// An orbit that a match reads or pushes: `row` of the orbit's index (kNoRow when its type is not
/// indexed), and the dart by which the match reached it first.
struct Role {
  OrbitType type;
  DartId dart = types::kNoDart;
  Row row = gmap::kNoRow;
};
/// A number that a match knows when it is made: random(seed, orbit of `role`).
struct Draw {
  std::int64_t seed = 0;
  std::uint32_t role = 0;
  bool operator==(const Draw&) const = default;
};

/// What is computed of an item.
struct Wanted {
  ExprPtr energy = nullptr;                        ///< a root of its own when `energy_value`
  bool energy_value = false;
  const std::vector<BodyForce>* forces = nullptr;  ///< the energy is differentiated for them
  std::vector<ExprPtr> values = {};                ///< a criterion's value, results, a field …
};
[[nodiscard]] Wanted wanted_forces(const InteractionBody& body, bool energy_value);
/// The value of a criterion, then its results in order.
[[nodiscard]] Wanted wanted_values(const CriterionBody& body);
/// The results of an interaction in order.
[[nodiscard]] Wanted wanted_results(const InteractionBody& body);

/// The total force on one vertex: minus the gradient of the energy plus the explicit parts.
struct ForceRoot {
  std::uint32_t role = 0;
  ir::NodeId total = ir::kNone;
};
/// One dart named by a force line: on which orbit its atomic force lives and which root it is.
/// Several darts of a match may lie in one vertex; then they share a root.
struct ForceTarget {
  std::uint32_t line = 0;   ///< of the item's force lines
  std::uint32_t root = 0;   ///< index into Shape::forces
  OrbitType orbit;
};

/// What all matches of one shape compute.
struct Shape {
  ir::Graph graph;
  std::vector<OrbitType> roles;  ///< orbit type of each role
  std::vector<Draw> draws;       ///< Input::Source::MatchValue number k is draws[k]
  ir::NodeId condition = ir::kNone;  ///< mask of the `where` steps; kNone: always
  ir::NodeId energy = ir::kNone;
  std::vector<ForceRoot> forces;
  std::vector<ForceTarget> targets;  ///< parallel to MatchRoles::targets
  std::vector<std::vector<ir::NodeId>> values;  ///< of each wanted value its parts (value_parts.h)
  std::vector<std::uint32_t> key;    ///< the decisions that lead here

  /// Every root there is, without kNone.
  [[nodiscard]] std::vector<ir::NodeId> roots() const;
  /// The inputs that some root depends on: numbers into graph.inputs(), ascending.
  [[nodiscard]] std::vector<std::uint32_t> live_inputs() const;
};

/// What one match contributes to the table of its shape.
struct MatchRoles {
  std::vector<Role> roles;
  std::vector<DartId> targets;  ///< the dart of each force target
  std::vector<std::uint32_t> atomic = {};  ///< atomic forces that the match goes through one by one
  std::vector<std::uint32_t> key;
  /// What its roles and its shape rest on besides the pattern, perhaps several times; after a failure
  /// what that rests on. Not complete when the match rests on a collection of the whole map:
  /// `everywhere`.
  std::vector<Dependence> walked = {};
  bool everywhere = false;
  std::uint8_t way = kNoWay;  ///< of the shape set, by which it was found
  static constexpr std::uint8_t kNoWay = 0xff;
};

/// Why there is no program for a match.
struct SpecialiseFailure {
  /// An optional value is missing, or a `where` on links and whole numbers is false: the item does
  /// not hold here, which is no error.
  bool not_here = false;
  support::Diagnostic diagnostic;
};

/// Who can list the atomic forces on an orbit, by numbers of its own.
class AtomicForceList {
 public:
  virtual ~AtomicForceList() = default;
  /// Appends those that live on sub-orbits of the orbit of `dart`, in canonical order.
  virtual void list(OrbitType orbit, DartId dart, std::vector<std::uint32_t>& out) const = 0;
};

/// The object that expressions speak about. The store must have an index for each orbit type whose
/// columns are gathered, `position`'s included.
struct World {
  const gmap::EmbeddingSchema& schema;
  const gmap::GMap& map;
  const gmap::EmbeddingStore& store;
  EmbeddingId position{};  ///< what energies are differentiated with respect to
  /// For criteria and fields; null where forces cannot be read.
  const AtomicForceList* atomic_forces = nullptr;
};

class SymbolicWalker;

/// Specialises one item. Everything given must outlive it; it may be used again after the map has
/// changed. Not for several threads at once.
class Specialiser {
 public:
  Specialiser(const World& world, const ItemBody& body, Wanted wanted, const ValueSources& sources);
  ~Specialiser();
  Specialiser(const Specialiser&) = delete;
  Specialiser& operator=(const Specialiser&) = delete;

  /// Roles and key of the match whose nodes (ItemBody::nodes) are these darts, without a graph.
  /// False: see failure().
  bool trace(std::span<const DartId> nodes, MatchRoles& out);
  /// The same and the graph.
  bool build(std::span<const DartId> nodes, MatchRoles& out, Shape& shape);
  [[nodiscard]] const SpecialiseFailure& failure() const { return failure_; }

 private:
  friend class ShapeSet;
  bool run(std::span<const DartId> nodes, MatchRoles& out, Shape* shape);

  Wanted wanted_;
  std::unique_ptr<SymbolicWalker> walker_;
  SpecialiseFailure failure_;
};

/// The shapes of an item's matches, made as they appear.
class ShapeSet {
 public:
  ShapeSet(const World& world, const ItemBody& body, Wanted wanted, const ValueSources& sources);
  ~ShapeSet();
  ShapeSet(const ShapeSet&) = delete;
  ShapeSet& operator=(const ShapeSet&) = delete;

  /// The number of the match's shape, built when it is new, and its roles (`out.key` is left
  /// alone on the fast path). Empty: see failure(), and `out.walked` still holds.
  std::optional<std::uint32_t> classify(std::span<const DartId> nodes, MatchRoles& out);
  /// Where a match was found by a way and no link on it has changed since: its roles now. False: orbits
  /// that were one role are several now, or the other way round.
  bool follow(std::uint8_t way, std::span<const DartId> nodes, std::vector<Role>& roles);
  [[nodiscard]] const SpecialiseFailure& failure() const { return specialiser_.failure(); }
  [[nodiscard]] std::size_t size() const { return shapes_.size(); }
  [[nodiscard]] const Shape& operator[](std::size_t shape) const { return *shapes_[shape]; }

 private:
  struct KeyHash {
    std::size_t operator()(const std::vector<std::uint32_t>& key) const;
  };
  struct FastWay;  // a walk program and the shape it leads to
  void add_fast_way(std::uint32_t shape);

  const World& world_;
  Specialiser specialiser_;
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::unordered_map<std::vector<std::uint32_t>, std::uint32_t, KeyHash> by_key_;
  std::vector<FastWay> fast_;
};

}  // namespace gmsim::compile
