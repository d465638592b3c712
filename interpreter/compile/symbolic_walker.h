// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compile/role_table.h"
#include "compile/specialise.h"
#include "compile/symbolic_value.h"
#include "compile/walk_program.h"
#include "compile/walked_orbits.h"

namespace gmsim::compile {

/// Evaluates an item's expressions at one match, numbers as nodes of a graph (or, without a graph,
/// not at all: the same decisions are taken and the same orbits met). Lets and parameters are
/// evaluated when they are first read, so what nobody wants costs nothing.
///
/// After a failure every function returns something harmless, and the first failure is kept.
class SymbolicWalker {
 public:
  SymbolicWalker(const World& world, const ItemBody& body, const ValueSources& sources);

  /// Begins a match; `graph` null: roles and decisions only.
  void start(std::span<const DartId> nodes, ir::Graph* graph);
  /// Are the walks of the next matches worth recording?
  void record_walks(bool record) { record_walks_ = record; }

  [[nodiscard]] SymbolicValue evaluate(const types::Expr& expr);
  [[nodiscard]] DartRef dart(const types::Expr& expr);
  void darts(const types::Expr& expr, std::vector<DartRef>& out);
  /// The condition of all `where` steps: known, or a mask.
  [[nodiscard]] SymbolicValue conditions();
  /// The one node of a number, known or not; a mask for a Bool.
  [[nodiscard]] ir::NodeId node(const SymbolicValue& value, const types::ValueType& type);
  /// All nodes of a value as value_parts says, a Bool as 0 or 1.
  [[nodiscard]] std::vector<ir::NodeId> nodes(const SymbolicValue& value,
                                              const types::ValueType& type);
  void bind(Slot slot, DartRef dart);

  /// The number of an orbit that the match meets, which becomes part of its key.
  std::uint32_t meet(OrbitType type, DartRef at);
  void fail(support::DiagnosticKind kind, Span where, std::string message, std::string help = {});
  [[nodiscard]] bool failed() const { return failure_.has_value(); }
  [[nodiscard]] SpecialiseFailure take_failure();

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const ItemBody& body() const { return body_; }
  [[nodiscard]] RoleTable& roles() { return roles_; }
  [[nodiscard]] WalkTrace& trace() { return trace_; }
  [[nodiscard]] std::vector<std::uint32_t> take_key() { return std::move(key_); }
  [[nodiscard]] const std::vector<Draw>& draws() const { return draws_; }
  [[nodiscard]] std::vector<std::uint32_t> take_atomic() { return std::move(atomic_); }
  /// MatchRoles::walked and `everywhere`.
  void take_walked(MatchRoles& out);
  /// By role: the input node of its position, kNone when it was not read.
  [[nodiscard]] const std::vector<ir::NodeId>& positions() const { return positions_; }
  /// What grad() was asked of: numbers whose derivatives are there already.
  [[nodiscard]] const std::vector<ir::NodeId>& differentiated() const { return differentiated_; }

 private:
  using Expr = types::Expr;
  using Op = ir::Op;
  using NodeId = ir::NodeId;

  /// A slot of a frame. What is pending is evaluated when it is read.
  struct Cell {
    enum class Kind : std::uint8_t { Empty, Ready, PendingLet, PendingParameter, Running };
    Kind kind = Kind::Empty;
    const Expr* let = nullptr;
    const BodyParameter* parameter = nullptr;
    SymbolicValue value;
  };
  using Frame = std::vector<Cell>;

  // symbolic_walker.cpp
  /// The match depends on the links of this dart, or of all darts of an orbit.
  void depend(DartId dart) { walked_.add(dart); }
  void depend(OrbitType orbit, DartId dart) { walked_.smallest(orbit, dart); }
  [[nodiscard]] Cell& cell(Slot slot) { return (*frame_)[types::index(slot)]; }
  void decide(std::uint32_t outcome) { key_.push_back(outcome); }
  void bind(Slot slot, SymbolicValue value);
  [[nodiscard]] const SymbolicValue& local(const Expr& expr);
  [[nodiscard]] SymbolicValue let(const Expr& expr);
  [[nodiscard]] SymbolicValue choice(const Expr& expr);
  [[nodiscard]] SymbolicValue select(const Expr& expr, NodeId mask, const SymbolicValue& yes,
                                     const SymbolicValue& no);
  [[nodiscard]] bool decided(const Expr& condition, const char* what);
  [[nodiscard]] SymbolicValue link_question(const Expr& expr);

  // symbolic_reads.cpp
  [[nodiscard]] SymbolicValue read(const Expr& reader, EmbeddingId id, DartRef at);
  [[nodiscard]] SymbolicValue read_source(const Expr& reader, EmbeddingId id, DartRef at);
  [[nodiscard]] bool carries_interaction(EmbeddingId parameter, DartRef at);
  [[nodiscard]] SymbolicValue read_parameter(const BodyParameter& parameter, const Expr& reader);
  [[nodiscard]] SymbolicValue read_column(const Expr& reader, EmbeddingId id, DartRef at);
  [[nodiscard]] SymbolicValue expand(const ValueSource& source, DartRef at, OrbitType orbit);
  [[nodiscard]] SymbolicValue constant(const types::ValueType& type,
                                       std::span<const double> numbers);
  [[nodiscard]] SymbolicValue has(const Expr& expr);
  [[nodiscard]] SymbolicValue random(const Expr& expr);
  [[nodiscard]] SymbolicValue clock(const Expr& expr);
  [[nodiscard]] SymbolicValue grad(const Expr& expr);
  void fail_missing(const Expr& reader, EmbeddingId id, DartId dart);

  // symbolic_arithmetic.cpp
  NodeId make(const Expr& at, Op op, NodeId a, NodeId b = ir::kNone, NodeId c = ir::kNone,
              std::uint32_t aux = 0);
  NodeId number(double value);
  [[nodiscard]] NodeId part(const SymbolicValue& value, std::size_t which) const;
  [[nodiscard]] SymbolicValue of_parts(std::initializer_list<NodeId> parts) const;
  /// A value where the literal 0 takes the type of the other operand.
  [[nodiscard]] SymbolicValue operand(const Expr& expr, const types::ValueType& type);
  [[nodiscard]] SymbolicValue mask(const Expr& at, NodeId real);
  [[nodiscard]] SymbolicValue arithmetic(const Expr& expr);
  [[nodiscard]] SymbolicValue negative(const Expr& expr);
  [[nodiscard]] SymbolicValue sum_or_difference(const Expr& expr);
  [[nodiscard]] SymbolicValue add(const Expr& at, const SymbolicValue& a, const SymbolicValue& b,
                                  const types::ValueType& type, Op op = Op::Add);
  [[nodiscard]] SymbolicValue product(const Expr& expr);
  [[nodiscard]] SymbolicValue matrix_product(const Expr& expr);
  [[nodiscard]] SymbolicValue quotient_of(const Expr& expr);
  [[nodiscard]] SymbolicValue divide(const Expr& at, const SymbolicValue& a,
                                     const SymbolicValue& b, const types::ValueType& type);
  [[nodiscard]] SymbolicValue power(const Expr& expr);
  [[nodiscard]] SymbolicValue comparison(const Expr& expr);
  [[nodiscard]] SymbolicValue equality(const Expr& expr);
  [[nodiscard]] SymbolicValue logic(const Expr& expr);
  [[nodiscard]] SymbolicValue tuple(const Expr& expr);
  [[nodiscard]] SymbolicValue component(const Expr& expr);
  [[nodiscard]] SymbolicValue element(const Expr& expr);

  // symbolic_builtins.cpp
  [[nodiscard]] SymbolicValue call(const Expr& expr);
  [[nodiscard]] std::optional<double> known_call(const Expr& expr,
                                                 std::span<const SymbolicValue> arguments) const;
  [[nodiscard]] SymbolicValue call2(const Expr& expr, std::span<const SymbolicValue> arguments);
  [[nodiscard]] SymbolicValue clamp(const Expr& expr, std::span<const SymbolicValue> arguments);
  [[nodiscard]] SymbolicValue polar2(const Expr& expr, const SymbolicValue& f);

  // symbolic_collections.cpp
  void polygon(const Expr& expr, std::vector<DartRef>& out);
  void trace_polygon(DartRef first, std::vector<DartRef>& corners);
  [[nodiscard]] std::vector<DartRef> traced_orbit(OrbitType type, DartRef at);
  void trace_orbit(OrbitType type, DartRef at, std::vector<DartRef>& members);
  void trace_quotient(OrbitType outer, OrbitType inner, DartRef at, std::vector<DartRef>& members);
  [[nodiscard]] std::shared_ptr<const std::vector<DartRef>> members(const Expr& collection);
  template <typename Body>
  void each(const Expr& fold, const Body& body);
  [[nodiscard]] SymbolicValue fold(const Expr& expr);
  [[nodiscard]] SymbolicValue fold_sum(const Expr& expr);
  [[nodiscard]] SymbolicValue fold_extreme(const Expr& expr);
  [[nodiscard]] SymbolicValue fold_count(const Expr& expr);
  [[nodiscard]] SymbolicValue fold_truth(const Expr& expr);
  [[nodiscard]] SymbolicValue fold_best(const Expr& expr);
  void fail_empty(const Expr& expr);

  // symbolic_forces.cpp
  [[nodiscard]] SymbolicValue force_on(const Expr& expr);
  [[nodiscard]] SymbolicValue atomic_forces(const Expr& expr);
  [[nodiscard]] SymbolicValue atomic_force(const Expr& collection, std::uint32_t number);
  bool forces_can_be_read(const Expr& expr);

  const World& world_;
  const ItemBody& body_;
  const ValueSources& sources_;
  ir::Graph* graph_ = nullptr;
  Frame item_frame_;
  Frame* frame_ = nullptr;
  std::deque<Frame> inner_frames_;  // of expanded expressions, by depth
  std::size_t depth_ = 0;
  RoleTable roles_;
  WalkTrace trace_;
  bool record_walks_ = true;
  std::vector<std::uint32_t> key_;
  std::vector<Draw> draws_;
  std::vector<std::uint32_t> atomic_;
  WalkedOrbits walked_;
  bool everywhere_ = false;
  std::vector<NodeId> positions_;
  std::vector<NodeId> differentiated_;
  std::optional<SpecialiseFailure> failure_;
  std::vector<std::optional<EmbeddingId>> presences_;  // of parameters, their interaction's mark
};

}  // namespace gmsim::compile
