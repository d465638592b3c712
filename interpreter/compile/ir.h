// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "support/span.h"
#include "types/builtin.h"
#include "types/expr.h"
#include "types/value_type.h"

/// What a rule computes, as numbers only: a hash-consed graph of typed operations. Everything
/// topological (walks, folds, predicates on links) is decided before; what is left is arithmetic on
/// inputs that are gathered once a match.
namespace gmsim::compile::ir {

using support::Span;
using types::EmbeddingId;
using types::ValueKind;

/// A node of a Graph. Operands always have smaller ids than their users.
enum class NodeId : std::uint32_t {};
inline constexpr NodeId kNone{0xffffffffu};
[[nodiscard]] constexpr std::uint32_t index(NodeId id) { return static_cast<std::uint32_t>(id); }

/// The operations; the rows, with their meaning as equations, live in ir_ops.def.
enum class Op : std::uint8_t {
#define IR_OP(id, name, operands, meaning) id,
#include "compile/ir_ops.def"
#undef IR_OP
};
[[nodiscard]] std::string_view name_of(Op op);
[[nodiscard]] int operand_count(Op op);

/// Where an input comes from.
struct Input {
  enum class Source : std::uint8_t {
    Embedding,  ///< value of `embedding` at the orbit of role `role`
    MatchValue, ///< number `role` of the match's own list: what a match knows when it is made
    ForceOn,    ///< N: internal atomic forces on the orbit of role `role`, summed; of all
                ///< interactions (`offset` 0), or of interaction `offset` - 1
    AtomicForce,///< N: number `role` of the match's list of atomic forces (MatchRoles::atomic)
    Time,       ///< s
    Dt,
    Step
  };
  Source source = Source::Embedding;
  EmbeddingId embedding{};
  std::uint32_t role = 0;    ///< position in the match's list of orbits
  std::uint32_t offset = 0;  ///< of an embedding: first double of its value that is meant
  bool operator==(const Input&) const = default;
};

struct InputHash {
  std::size_t operator()(const Input& input) const;
};

struct Node {
  Op op = Op::Constant;
  ValueKind type = ValueKind::Real;  ///< Bool (a mask, never an input), Real, Vec3, Mat3, Sym3
  std::array<NodeId, 3> operands = {kNone, kNone, kNone};
  double constant = 0;      ///< Constant: the number, every entry of a zero vector or matrix, 0/1 of a mask
  std::uint32_t aux = 0;    ///< Input: number of the input; Component: which one
  Span span = {};           ///< the expression it came from, for messages; no part of identity
};

/// A hash-consed graph: equal nodes are one node, constants are folded and neutral elements
/// dropped when a node is made, so building is simplifying. Int and Bool values are Real 0/1 … only
/// where a rule uses them as numbers; conditions are masks. Vec2, Mat2 and arrays do not occur:
/// they are taken apart into Real when the graph is built.
class Graph {
 public:
  NodeId constant(double value);
  NodeId mask(bool value);
  NodeId input(const Input& input, ValueKind type, Span span = {});
  /// Makes (or finds) op(a, b, c) with its result type, after simplification.
  NodeId make(Op op, NodeId a, NodeId b = kNone, NodeId c = kNone, std::uint32_t aux = 0,
              Span span = {});
  /// The same without simplification.
  NodeId make_plain(Op op, NodeId a, NodeId b = kNone, NodeId c = kNone, std::uint32_t aux = 0,
                    Span span = {});
  NodeId zero(ValueKind type);

  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[compile::ir::index(id)]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] std::span<const Input> inputs() const { return inputs_; }
  [[nodiscard]] bool is_zero(NodeId id) const;

 private:
  NodeId intern(const Node& node);

  std::vector<Node> nodes_;
  std::vector<Input> inputs_;
  std::unordered_map<Input, std::uint32_t, InputHash> input_numbers_;
  std::unordered_map<std::size_t, std::vector<NodeId>> table_;
};

/// Gradient of the Real node `y` with respect to each of `inputs` by reverse accumulation in the same
/// graph. They are mostly input nodes, but may be any of Real or Vec3, which is then taken as
/// independent of what it is computed from. Frozen is a barrier; the derivative of norm(d) is
/// normalize(d), zero at zero length.
[[nodiscard]] std::vector<NodeId> gradient(Graph& graph, NodeId y, std::span<const NodeId> inputs);

/// Derivative of any node along a direction given for some inputs, by forward accumulation:
/// `seeds[k]` is the tangent of `inputs[k]`, of its type.
[[nodiscard]] NodeId directional(Graph& graph, NodeId y, std::span<const NodeId> inputs,
                                 std::span<const NodeId> seeds);

/// Which nodes some root depends on, roots included; kNone among the roots is passed over.
[[nodiscard]] std::vector<bool> reachable(const Graph& graph, std::span<const NodeId> roots);

/// "n12 = dot n4 n7" a line, reachable from `roots`.
[[nodiscard]] std::string to_string(const Graph& graph, std::span<const NodeId> roots);

}  // namespace gmsim::compile::ir
