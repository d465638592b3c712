// SPDX-License-Identifier: MIT
// The operations of register programs for one instruction set: a translation unit defines
// GMSIM_ISA_NAMESPACE and GMSIM_VECTOR_BYTES, includes this once and is compiled with the matching
// flags. Nothing here may call inline code that other units have too.
#include "engine/builtins.h"
#include "engine/kernel/block_frame.h"
#include "engine/kernel/lane_functions.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace gmsim::engine::GMSIM_ISA_NAMESPACE {
namespace {

using Instruction = compile::KernelInstruction;

// Each builds on those before it.
// clang-format off
#include "engine/kernel/vector.h"
#include "engine/kernel/vector_math.h"
#include "engine/kernel/vector_polar.h"
#include "engine/kernel/ops_move.h"
#include "engine/kernel/ops_sum.h"
#include "engine/kernel/ops_real.h"
#include "engine/kernel/ops_tensor.h"
#include "engine/kernel/ops_coarse.h"
// clang-format on

enum Kind { Number, Vec3, Sym3, Mat3 };

OpTable make_table() {
  using compile::KernelOp;
  OpTable table;
  const auto row = [&](KernelOp op) { return table.code[static_cast<std::size_t>(op)]; };
  const auto set = [&](KernelOp op, OpKernel code) {
    for (int kind = Number; kind <= Mat3; ++kind) row(op)[kind] = code;
  };
#define GMSIM_ALL_TYPES(op, name)      \
  row(KernelOp::op)[Number] = name<1>; \
  row(KernelOp::op)[Vec3] = name<3>;   \
  row(KernelOp::op)[Sym3] = name<6>;   \
  row(KernelOp::op)[Mat3] = name<9>;
#define GMSIM_MATRICES(op, of_sym, of_mat) \
  row(KernelOp::op)[Sym3] = of_sym;        \
  row(KernelOp::op)[Mat3] = of_mat;
  GMSIM_ALL_TYPES(Gather, gather)
  set(KernelOp::GatherDifference, gather_difference);
  GMSIM_ALL_TYPES(Store, store)
  set(KernelOp::MulAdd, mul_add);
  set(KernelOp::MulSub, mul_sub);
  set(KernelOp::SubMul, sub_mul);
  GMSIM_ALL_TYPES(ScaleAdd, scale_add)
  GMSIM_ALL_TYPES(SubScale, subtract_scaled)
  set(KernelOp::UnitNorm, unit_and_norm);
  set(KernelOp::WholePow, whole_power);
  GMSIM_ALL_TYPES(Add, add)
  GMSIM_ALL_TYPES(Sub, subtract)
  GMSIM_ALL_TYPES(Neg, negate)
  set(KernelOp::Mul, mul);
  GMSIM_ALL_TYPES(Div, divide)
  GMSIM_ALL_TYPES(Scale, scale)
  set(KernelOp::Pow, power_of);
  set(KernelOp::Sqrt, square_root);
  set(KernelOp::Abs, absolute);
  set(KernelOp::Sign, sign);
  set(KernelOp::Min, minimum);
  set(KernelOp::Max, maximum);
  set(KernelOp::Floor, round_down);
  set(KernelOp::Ceil, round_up);
  set(KernelOp::Mod, remainder);
  set(KernelOp::Exp, exponential);
  set(KernelOp::Log, logarithm);
  set(KernelOp::Sin, sine);
  set(KernelOp::Cos, cosine);
  set(KernelOp::Tan, tangent);
  set(KernelOp::Asin, arc_sine);
  set(KernelOp::Acos, arc_cosine);
  set(KernelOp::Atan, arc_tangent);
  set(KernelOp::Atan2, arc_tangent2);
  set(KernelOp::Tanh, hyperbolic_tangent);
  set(KernelOp::Vector, vector);
  set(KernelOp::Dot, dot);
  set(KernelOp::Cross, cross);
  set(KernelOp::Norm, norm);
  set(KernelOp::Normalize, normalize);
  set(KernelOp::Outer, outer);
  GMSIM_MATRICES(MatVec, matrix_times_vector<6>, matrix_times_vector<9>)
  set(KernelOp::MatMul, matrix_times_matrix);
  set(KernelOp::Transpose, transpose);
  GMSIM_MATRICES(Trace, trace<6>, trace<9>)
  GMSIM_MATRICES(Det, determinant<6>, determinant<9>)
  GMSIM_MATRICES(Inverse, inverse<6>, inverse<9>)
  GMSIM_MATRICES(Contract, contract_symmetric, contract)
  set(KernelOp::Sym, symmetric);
  set(KernelOp::Full, full);
  set(KernelOp::Columns, columns);
  set(KernelOp::Diagonal, diagonal);
  set(KernelOp::Polar, polar);
  set(KernelOp::MaxEigenvalue, eigenvalue<0>);
  set(KernelOp::MaxEigenvector, eigenvector<0>);
  set(KernelOp::MinEigenvalue, eigenvalue<2>);
  set(KernelOp::MinEigenvector, eigenvector<2>);
  set(KernelOp::Less, less);
  set(KernelOp::LessEqual, less_equal);
  set(KernelOp::Equal, equal);
  set(KernelOp::And, both);
  set(KernelOp::Or, either);
  set(KernelOp::Not, negation);
  GMSIM_ALL_TYPES(Select, choose)
#undef GMSIM_ALL_TYPES
#undef GMSIM_MATRICES
  table.sum_slots = sum_slots;
  table.sum_shares = sum_shares;
  return table;
}

}  // namespace

const OpTable& op_table() {
  static const OpTable table = make_table();
  return table;
}

}  // namespace gmsim::engine::GMSIM_ISA_NAMESPACE
