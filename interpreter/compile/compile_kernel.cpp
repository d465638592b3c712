// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "compile/kernel.h"
#include "compile/kernel_registers.h"
#include "compile/whole_power.h"
#include "support/check.h"

namespace gmsim::compile {
namespace {

using ir::kNone;
using ir::Node;
using ir::NodeId;
using ir::Op;
using ir::ValueKind;

std::uint8_t rows_of(ValueKind kind) {
  return kind == ValueKind::Bool ? 1
                                 : static_cast<std::uint8_t>(types::component_count({kind, {}}));
}

/// The instruction of the same name; operations that are only views have none.
std::optional<KernelOp> plain_op(Op op) {
  switch (op) {
#define PLAIN(id) \
  case Op::id:    \
    return KernelOp::id;
    PLAIN(Add)
    PLAIN(Sub)
    PLAIN(Neg) PLAIN(Mul) PLAIN(Div) PLAIN(Scale) PLAIN(Pow) PLAIN(Sqrt) PLAIN(Abs) PLAIN(Sign)
        PLAIN(Min) PLAIN(Max) PLAIN(Floor) PLAIN(Ceil) PLAIN(Mod) PLAIN(Exp) PLAIN(Log) PLAIN(Sin)
            PLAIN(Cos) PLAIN(Tan) PLAIN(Asin) PLAIN(Acos) PLAIN(Atan) PLAIN(Atan2) PLAIN(Tanh)
                PLAIN(Vector) PLAIN(Dot) PLAIN(Cross) PLAIN(Norm) PLAIN(Normalize) PLAIN(Outer)
                    PLAIN(MatVec) PLAIN(MatMul) PLAIN(Transpose) PLAIN(Trace) PLAIN(Det)
                        PLAIN(Inverse) PLAIN(Contract) PLAIN(Sym) PLAIN(Full) PLAIN(Columns)
                            PLAIN(Diagonal) PLAIN(Polar) PLAIN(MaxEigenvalue) PLAIN(MaxEigenvector)
                                PLAIN(MinEigenvalue) PLAIN(MinEigenvector) PLAIN(Less)
                                    PLAIN(LessEqual) PLAIN(Equal) PLAIN(And) PLAIN(Or) PLAIN(Not)
                                        PLAIN(Select)
#undef PLAIN
                                            case Op::Constant : case Op::Input : case Op::Component
        : case Op::AsReal : case Op::Frozen : return std::nullopt;
  }
  return std::nullopt;
}

/// The type that tells instructions of one name apart: of the result, or of the matrix that is
/// read.
ValueKind telling_type(const ir::Graph& graph, const Node& node) {
  switch (node.op) {
    case Op::MatVec:
    case Op::Trace:
    case Op::Det:
    case Op::Inverse:
    case Op::Contract:
      return graph[node.operands[0]].type;
    default:
      return node.type;
  }
}

/// A view: rows of what another node computes.
struct View {
  NodeId owner = kNone;
  std::uint8_t row = 0;
};

/// Chooses instructions: a walk from the roots down, what an instruction reads before itself.
class Selection {
 public:
  Selection(const ir::Graph& graph, std::span<const NodeId> roots) : graph_(graph), roots_(roots) {
    const std::vector<bool> live = ir::reachable(graph, roots);
    views_.resize(graph.size());
    uses_.resize(graph.size());
    needed_as_such_.resize(graph.size());
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      if (live[i]) view(NodeId{i});
    pair_norms(live);
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      if (live[i]) count_uses(graph[NodeId{i}]);
    for (const NodeId root : roots) use(root, true);
    number_inputs(live);
    find_uniform();
    find_needs(live);
  }

  void run(RegisterPlan& plan) {
    done_.assign(graph_.size(), false);
    for (std::uint32_t k = 0; k < roots_.size(); ++k) {
      emit_all(roots_[k], plan);
      const View view = value_of(roots_[k]);
      const ValueKind type = graph_[roots_[k]].type;
      plan.instruction({.op = KernelOp::Store,
                        .type = type,
                        .operands = {{{view.owner, view.row, rows_of(type)}}},
                        .numbers = {k, 0},
                        .span = graph_[roots_[k]].span});
    }
  }
  [[nodiscard]] const std::vector<KernelInput>& inputs() const { return inputs_; }

 private:
  /// The instruction that computes a node.
  struct Choice {
    KernelOp op{};
    ValueKind type = ValueKind::Real;
    std::array<NodeId, 3> operands = {kNone, kNone, kNone};
    std::array<std::uint32_t, 2> numbers = {};
    std::uint8_t rows = 0;
  };

  void view(NodeId id) {
    const Node& node = graph_[id];
    views_[index(id)] = {id, 0};
    if (node.op != Op::Component && node.op != Op::Frozen && node.op != Op::AsReal) return;
    views_[index(id)] = views_[index(node.operands[0])];
    if (node.op == Op::Component && graph_[views_[index(id)].owner].op != Op::Constant)
      views_[index(id)].row = static_cast<std::uint8_t>(views_[index(id)].row + node.aux);
  }
  /// A norm whose unit vector is wanted too becomes the row after it.
  void pair_norms(const std::vector<bool>& live) {
    std::unordered_map<std::uint32_t, std::uint32_t> units;
    for (std::uint32_t i = 0; i < graph_.size(); ++i)
      if (live[i] && graph_[NodeId{i}].op == Op::Normalize)
        units[index(graph_[NodeId{i}].operands[0])] = i;
    for (std::uint32_t i = 0; i < graph_.size(); ++i) {
      const Node& node = graph_[NodeId{i}];
      if (!live[i] || node.op != Op::Norm) continue;
      const auto unit = units.find(index(node.operands[0]));
      if (unit == units.end()) continue;
      with_norm_.push_back(NodeId{unit->second});
      for (View& view : views_)
        if (view.owner == NodeId{i}) view = {NodeId{unit->second}, 3};
    }
  }
  void count_uses(const Node& node) {
    if (node.op == Op::Component || node.op == Op::Frozen || node.op == Op::AsReal) return;
    for (const NodeId operand : node.operands) {
      if (operand == kNone) continue;
      use(operand, !is_difference_of_inputs(node));
    }
  }
  void use(NodeId id, bool as_such) {
    const NodeId owner = value_of(id).owner;
    ++uses_[index(owner)];
    if (as_such) needed_as_such_[index(owner)] = true;
  }
  void number_inputs(const std::vector<bool>& live) {
    std::vector<ValueKind> types(graph_.inputs().size());
    std::vector<bool> used(graph_.inputs().size());
    for (std::uint32_t i = 0; i < graph_.size(); ++i) {
      const Node& node = graph_[NodeId{i}];
      if (!live[i] || node.op != Op::Input) continue;
      used[node.aux] = true;
      types[node.aux] = node.type;
    }
    positions_.resize(used.size());
    for (std::uint32_t k = 0; k < used.size(); ++k) {
      if (!used[k]) continue;
      positions_[k] = static_cast<std::uint32_t>(inputs_.size());
      using Source = ir::Input::Source;
      const Source source = graph_.inputs()[k].source;
      const bool uniform = source == Source::Time || source == Source::Dt || source == Source::Step;
      inputs_.push_back({k, types[k], uniform});
    }
  }

  void find_uniform() {
    uniform_.resize(graph_.size());
    for (std::uint32_t i = 0; i < graph_.size(); ++i) {
      const Node& node = graph_[NodeId{i}];
      uniform_[i] = node.op != Op::Input || inputs_.empty()
                        ? std::all_of(node.operands.begin(), node.operands.end(),
                                      [&](NodeId a) { return a == kNone || uniform_[index(a)]; })
                        : inputs_[positions_[node.aux]].uniform;
    }
  }

  /// Rows needed to compute each node, as if nothing were shared.
  void find_needs(const std::vector<bool>& live) {
    needs_.resize(graph_.size());
    for (std::uint32_t i = 0; i < graph_.size(); ++i) {
      const Node& node = graph_[NodeId{i}];
      if (!live[i] || uniform_[i]) continue;
      std::array<std::pair<std::uint32_t, std::uint32_t>, 3> operands = {};  // need, rows
      for (int k = 0; k < ir::operand_count(node.op); ++k)
        operands[k] = {needs_[index(node.operands[k])], rows_of(graph_[node.operands[k]].type)};
      std::sort(operands.rbegin(), operands.rend());
      std::uint32_t held = 0;
      needs_[i] = rows_of(node.type);
      for (const auto& [need, rows] : operands) {
        needs_[i] = std::max(needs_[i], held + need);
        held += rows;
      }
    }
  }

  [[nodiscard]] View value_of(NodeId id) const { return views_[index(id)]; }
  [[nodiscard]] bool is_vector_input(NodeId id) const {
    return graph_[id].op == Op::Input && graph_[id].type == ValueKind::Vec3;
  }
  [[nodiscard]] bool is_difference_of_inputs(const Node& node) const {
    return node.op == Op::Sub && is_vector_input(node.operands[0]) &&
           is_vector_input(node.operands[1]);
  }
  /// A product that nobody else wants can be computed together with the sum it goes into.
  [[nodiscard]] bool is_own_product(NodeId id) const {
    const Op op = graph_[id].op;
    return (op == Op::Mul || op == Op::Scale) && uses_[index(id)] == 1 && !uniform_[index(id)];
  }

  [[nodiscard]] Choice choose(NodeId id) const {
    const Node& node = graph_[id];
    Choice choice{
        .type = telling_type(graph_, node), .operands = node.operands, .rows = rows_of(node.type)};
    if (node.op == Op::Input) {
      choice.op = KernelOp::Gather;
      choice.numbers[0] = positions_[node.aux];
      return choice;
    }
    choice.op = plain_op(node.op).value();
    if (node.op == Op::Pow) choose_power(node, choice);
    if (node.op == Op::Add || node.op == Op::Sub) choose_sum(node, choice);
    if (node.op == Op::Normalize &&
        std::find(with_norm_.begin(), with_norm_.end(), id) != with_norm_.end()) {
      choice.op = KernelOp::UnitNorm;
      choice.rows = 4;
    }
    return choice;
  }
  void choose_power(const Node& node, Choice& choice) const {
    const Node& exponent = graph_[value_of(node.operands[1]).owner];
    if (exponent.op != Op::Constant) return;
    const double y = exponent.constant;
    const bool whole = is_small_whole(y);
    if (!whole && y != 0.5) return;
    choice.op = whole ? KernelOp::WholePow : KernelOp::Sqrt;
    choice.operands[1] = kNone;
    if (whole) choice.numbers[0] = static_cast<std::uint32_t>(static_cast<std::int32_t>(y));
  }
  void choose_sum(const Node& node, Choice& choice) const {
    const NodeId a = node.operands[0], b = node.operands[1];
    if (is_difference_of_inputs(node) &&
        !(needed_as_such_[index(a)] && needed_as_such_[index(b)])) {
      choice.op = KernelOp::GatherDifference;
      choice.operands = {kNone, kNone, kNone};
      choice.numbers = {positions_[graph_[a].aux], positions_[graph_[b].aux]};
    } else if (node.op == Op::Add && (is_own_product(a) || is_own_product(b))) {
      const auto [product, rest] = is_own_product(a) ? std::pair{a, b} : std::pair{b, a};
      fuse(product, rest, KernelOp::MulAdd, KernelOp::ScaleAdd, choice);
    } else if (node.op == Op::Sub && is_own_product(b)) {
      fuse(b, a, KernelOp::SubMul, KernelOp::SubScale, choice);
    } else if (node.op == Op::Sub && is_own_product(a) && graph_[a].op == Op::Mul) {
      fuse(a, b, KernelOp::MulSub, KernelOp::MulSub, choice);
    }
  }
  void fuse(NodeId product, NodeId rest, KernelOp of_numbers, KernelOp of_tensors,
            Choice& choice) const {
    const Node& factors = graph_[product];
    choice.op = factors.op == Op::Mul ? of_numbers : of_tensors;
    choice.operands = {factors.operands[0], factors.operands[1], rest};
  }

  void emit_all(NodeId root, RegisterPlan& plan) {
    std::vector<NodeId> stack = {value_of(root).owner};
    while (!stack.empty()) {
      const NodeId id = stack.back();
      const std::size_t height = stack.size();
      if (!done_[index(id)]) push_operands(id, stack);
      if (stack.size() > height) continue;
      stack.pop_back();
      if (!done_[index(id)]) emit(id, plan);
      done_[index(id)] = true;
    }
  }
  /// What needs most registers is computed first, when fewest are taken (Sethi & Ullman 1970).
  void push_operands(NodeId id, std::vector<NodeId>& stack) const {
    if (graph_[id].op == Op::Constant) return;
    const Choice choice = choose(id);
    const auto first = static_cast<std::ptrdiff_t>(stack.size());
    for (int k = operand_count(choice.op) - 1; k >= 0; --k) {
      const NodeId owner = value_of(choice.operands[k]).owner;
      if (!done_[index(owner)]) stack.push_back(owner);
    }
    std::stable_sort(stack.begin() + first, stack.end(),
                     [&](NodeId a, NodeId b) { return needs_[index(a)] < needs_[index(b)]; });
  }
  void emit(NodeId id, RegisterPlan& plan) const {
    const Node& node = graph_[id];
    if (node.op == Op::Constant) return plan.constant(id, rows_of(node.type), node.constant);
    const Choice choice = choose(id);
    PlannedInstruction planned{.op = choice.op,
                               .type = choice.type,
                               .result = id,
                               .rows = choice.rows,
                               .uniform = uniform_[index(id)],
                               .numbers = choice.numbers,
                               .span = node.span};
    for (int k = 0; k < operand_count(choice.op); ++k) {
      const View view = value_of(choice.operands[k]);
      planned.operands[k] = {view.owner, view.row, rows_of(graph_[choice.operands[k]].type)};
    }
    plan.instruction(planned);
  }

  const ir::Graph& graph_;
  std::span<const NodeId> roots_;
  std::vector<View> views_;
  std::vector<std::uint32_t> uses_;
  std::vector<bool> uniform_;
  std::vector<std::uint32_t> needs_;
  std::vector<bool> needed_as_such_;  // by something else than a difference of two inputs
  std::vector<NodeId> with_norm_;
  std::vector<KernelInput> inputs_;
  std::vector<std::uint32_t> positions_;  // in inputs_, by number of the graph's input
  std::vector<bool> done_;
};

}  // namespace

Kernel compile_kernel(const ir::Graph& graph, std::span<const NodeId> roots,
                      const KernelOptions& options) {
  Kernel kernel;
  for (const NodeId root : roots) {
    GMSIM_CHECK(root != kNone, "a kernel without a value for a root");
    kernel.outputs.push_back({root, graph[root].type});
  }
  Selection selection(graph, roots);
  RegisterPlan plan;
  selection.run(plan);
  kernel.inputs = selection.inputs();
  plan.finish(options.block, kernel);
  return kernel;
}

}  // namespace gmsim::compile
