// SPDX-License-Identifier: MIT
#include "engine/ir_evaluate.h"

#include <algorithm>
#include <cmath>

#include "engine/builtins.h"
#include "engine/ir_tensors.h"
#include "engine/kernel/lane_functions.h"
#include "engine/tree_eval.h"
#include "support/check.h"

namespace gmsim::engine {

namespace ir = compile::ir;
using ir::Op;
using types::ValueKind;

namespace {

std::uint32_t entry_count(ValueKind kind) {
  return kind == ValueKind::Bool ? 1 : types::component_count({kind});
}

long double modulo(long double x, long double divisor) {
  const long double rest = std::fmod(x, divisor);
  return rest != 0 && (rest < 0) != (divisor < 0) ? rest + divisor : rest;
}

/// In double the functions of the kernels.
#define GMSIM_FUNCTION(name)                                  \
  double name##_of(double x) { return fixed_order::name(x); } \
  long double name##_of(long double x) { return std::name(x); }
GMSIM_FUNCTION(exp)
GMSIM_FUNCTION(log)
GMSIM_FUNCTION(sin)
GMSIM_FUNCTION(cos)
GMSIM_FUNCTION(tan)
GMSIM_FUNCTION(asin)
GMSIM_FUNCTION(acos)
GMSIM_FUNCTION(atan)
GMSIM_FUNCTION(tanh)
#undef GMSIM_FUNCTION
double atan2_of(double y, double x) { return fixed_order::atan2(y, x); }
long double atan2_of(long double y, long double x) { return std::atan2(y, x); }

double power_of(double x, double y) { return power(x, y); }
long double power_of(long double x, long double y) { return std::pow(x, y); }

}  // namespace

template <typename Number>
IrEvaluator<Number>::IrEvaluator(const Ir& graph)
    : graph_(graph), inputs_(graph.inputs().size()), values_(graph.size()) {}

template <typename Number>
void IrEvaluator<Number>::set_input(std::uint32_t input, std::span<const Number> entries) {
  std::copy(entries.begin(), entries.end(), inputs_.at(input).begin());
}

template <typename Number>
void IrEvaluator<Number>::run() {
  values_.resize(graph_.size());
  for (std::uint32_t i = 0; i < graph_.size(); ++i) {
    const ir::Node& node = graph_[NodeId{i}];
    Entries& out = values_[i];
    const auto operand = [&](int k) -> const Entries& { return (*this)[node.operands[k]]; };
    switch (node.op) {
      case Op::Constant:
        out.fill(static_cast<Number>(node.constant));
        break;
      case Op::Input:
        out = inputs_[node.aux];
        break;
      case Op::Frozen:
        out = operand(0);
        break;
      case Op::Select:
        out = operand(operand(0)[0] != 0 ? 1 : 2);
        break;
      default:
        if (ir::operand_count(node.op) <= 2 && graph_[node.operands[0]].type <= ValueKind::Real &&
            node.type <= ValueKind::Real) {
          scalar(node, out[0]);
        } else {
          tensor(node, out);
        }
    }
  }
}

/// Operations from numbers and masks to numbers and masks.
template <typename Number>
void IrEvaluator<Number>::scalar(const ir::Node& node, Number& out) const {
  const Number x = number(node.operands[0]);
  const Number y = ir::operand_count(node.op) > 1 ? number(node.operands[1]) : Number(0);
  switch (node.op) {
    case Op::Add: out = x + y; return;
    case Op::Sub: out = x - y; return;
    case Op::Neg: out = -x; return;
    case Op::Mul: out = x * y; return;
    case Op::Div: out = x / y; return;
    case Op::Pow: out = power_of(x, y); return;
    case Op::Sqrt: out = std::sqrt(x); return;
    case Op::Abs: out = std::abs(x); return;
    case Op::Sign: out = static_cast<Number>(x > 0) - static_cast<Number>(x < 0); return;
    case Op::Min: out = y < x ? y : x; return;
    case Op::Max: out = x < y ? y : x; return;
    case Op::Floor: out = std::floor(x); return;
    case Op::Ceil: out = std::ceil(x); return;
    case Op::Mod: out = modulo(x, y); return;
    case Op::Exp: out = exp_of(x); return;
    case Op::Log: out = log_of(x); return;
    case Op::Sin: out = sin_of(x); return;
    case Op::Cos: out = cos_of(x); return;
    case Op::Tan: out = tan_of(x); return;
    case Op::Asin: out = asin_of(x); return;
    case Op::Acos: out = acos_of(x); return;
    case Op::Atan: out = atan_of(x); return;
    case Op::Atan2: out = atan2_of(x, y); return;
    case Op::Tanh: out = tanh_of(x); return;
    case Op::Less: out = x < y; return;
    case Op::LessEqual: out = x <= y; return;
    case Op::Equal: out = x == y; return;
    case Op::And: out = x != 0 && y != 0; return;
    case Op::Or: out = x != 0 || y != 0; return;
    case Op::Not: out = x == 0; return;
    case Op::AsReal: out = x; return;
    default: GMSIM_CHECK(false, "no operation on numbers");
  }
}

/// Operations that take or give vectors and matrices.
template <typename Number>
void IrEvaluator<Number>::tensor(const ir::Node& node, Entries& out) const {
  namespace t = ir_tensors;
  const Entries& a = (*this)[node.operands[0]];
  const Entries& b = node.operands[1] == ir::kNone ? a : (*this)[node.operands[1]];
  const ValueKind kind = graph_[node.operands[0]].type;
  const std::uint32_t count = entry_count(node.type);
  const auto full = [&] { return kind == ValueKind::Sym3 ? t::full(a) : a; };
  switch (node.op) {
    case Op::Add: for (std::uint32_t i = 0; i < count; ++i) out[i] = a[i] + b[i]; return;
    case Op::Sub: for (std::uint32_t i = 0; i < count; ++i) out[i] = a[i] - b[i]; return;
    case Op::Neg: for (std::uint32_t i = 0; i < count; ++i) out[i] = -a[i]; return;
    case Op::Div: for (std::uint32_t i = 0; i < count; ++i) out[i] = a[i] / b[0]; return;
    case Op::Scale: for (std::uint32_t i = 0; i < count; ++i) out[i] = b[i] * a[0]; return;
    case Op::Vector: out = {a[0], b[0], number(node.operands[2])}; return;
    case Op::Component: out[0] = a[node.aux]; return;
    case Op::Dot: out[0] = t::dot(a, b); return;
    case Op::Cross: out = t::cross(a, b); return;
    case Op::Norm: out[0] = t::norm(a); return;
    case Op::Normalize: out = t::normalize(a); return;
    case Op::Outer: out = t::outer(a, b); return;
    case Op::MatVec: out = t::matrix_times_vector(full(), b); return;
    case Op::MatMul: out = t::matrix_times_matrix(a, b); return;
    case Op::Transpose: out = t::transpose(a); return;
    case Op::Trace: out[0] = kind == ValueKind::Sym3 ? a[0] + a[1] + a[2] : a[0] + a[4] + a[8]; return;
    case Op::Det: out[0] = t::determinant(full()); return;
    case Op::Inverse:
      out = t::inverse(full());
      if (kind == ValueKind::Sym3) out = t::symmetric(out);
      return;
    case Op::Contract: out[0] = kind == ValueKind::Sym3 ? t::contract_symmetric(a, b) : t::contract(a, b); return;
    case Op::Sym: out = t::symmetric(a); return;
    case Op::Full: out = t::full(a); return;
    case Op::Columns: out = t::columns(a, b, (*this)[node.operands[2]]); return;
    case Op::Diagonal: out = {a[0], a[1], a[2], 0, 0, 0}; return;
    case Op::Polar: out = t::polar(a); return;
    case Op::MaxEigenvalue: out[0] = t::eigenpair(a, 0)[0]; return;
    case Op::MinEigenvalue: out[0] = t::eigenpair(a, 2)[0]; return;
    case Op::MaxEigenvector: case Op::MinEigenvector: {
      const Entries pair = t::eigenpair(a, node.op == Op::MaxEigenvector ? 0 : 2);
      out = {pair[1], pair[2], pair[3]};
      return;
    }
    default: GMSIM_CHECK(false, "no operation on vectors or matrices");
  }
}

template <typename Number>
void gather_inputs(const compile::Shape& shape, std::span<const compile::Role> roles,
                   const State& state, IrEvaluator<Number>& evaluator) {
  TreeEvaluator tree(state);
  const auto inputs = shape.graph.inputs();
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    const ir::Input& input = inputs[k];
    std::vector<double> value;
    switch (input.source) {
      case ir::Input::Source::Embedding: {
        value.resize(types::component_count(state.program.schema[input.embedding].type));
        if (!tree.read(input.embedding, roles[input.role].dart, value))
          std::fill(value.begin(), value.end(), NAN);
        if (tree.failed()) (void)tree.take_failure();
        value.erase(value.begin(), value.begin() + input.offset);
        break;
      }
      case ir::Input::Source::MatchValue: {
        const compile::Draw& draw = shape.draws[input.role];
        const compile::Role& role = roles[draw.role];
        value = {random_number(draw.seed, state, role.type, role.dart)};
        break;
      }
      case ir::Input::Source::ForceOn:
      case ir::Input::Source::AtomicForce: GMSIM_CHECK(false, "a state has no forces"); break;
      case ir::Input::Source::Time: value = {state.time}; break;
      case ir::Input::Source::Dt: value = {state.dt}; break;
      case ir::Input::Source::Step: value = {static_cast<double>(state.step)}; break;
    }
    std::vector<Number> entries(value.begin(), value.end());
    entries.resize(std::min<std::size_t>(entries.size(), 9));
    evaluator.set_input(k, entries);
  }
}

template class IrEvaluator<double>;
template class IrEvaluator<long double>;
template void gather_inputs(const compile::Shape&, std::span<const compile::Role>, const State&,
                            IrEvaluator<double>&);
template void gather_inputs(const compile::Shape&, std::span<const compile::Role>, const State&,
                            IrEvaluator<long double>&);

}  // namespace gmsim::engine
