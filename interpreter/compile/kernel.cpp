// SPDX-License-Identifier: MIT
#include "compile/kernel.h"

#include <fmt/format.h>

namespace gmsim::compile {
namespace {

struct OpRow {
  std::string_view name;
  int operands;
};
constexpr OpRow kOps[] = {
#define KERNEL_OP(id, name, operands, meaning) {name, operands},
#include "compile/kernel_ops.def"
#undef KERNEL_OP
};

/// Arithmetic of one instruction; coarse operations by the usual count of their algorithm.
std::uint32_t cost(const KernelInstruction& instruction) {
  const std::uint32_t rows = instruction.d.rows;
  const bool symmetric = instruction.type == ir::ValueKind::Sym3;
  switch (instruction.op) {
    case KernelOp::Gather:
    case KernelOp::Store:
    case KernelOp::Vector:
    case KernelOp::Transpose:
    case KernelOp::Full:
    case KernelOp::Columns:
    case KernelOp::Diagonal:
      return 0;
    case KernelOp::MulAdd:
    case KernelOp::MulSub:
    case KernelOp::SubMul:
    case KernelOp::ScaleAdd:
    case KernelOp::SubScale:
      return 2 * rows;
    case KernelOp::UnitNorm:
    case KernelOp::Normalize:
      return 9;
    case KernelOp::Norm:
      return 6;
    case KernelOp::WholePow:
      return 4;
    case KernelOp::Dot:
      return 5;
    case KernelOp::Cross:
      return 9;
    case KernelOp::MatVec:
      return 15;
    case KernelOp::MatMul:
      return 45;
    case KernelOp::Trace:
      return 2;
    case KernelOp::Det:
      return 14;
    case KernelOp::Inverse:
      return 42;
    case KernelOp::Contract:
      return symmetric ? 12 : 17;
    case KernelOp::Sym:
      return 6;
    case KernelOp::Polar:
    case KernelOp::MaxEigenvalue:
    case KernelOp::MaxEigenvector:
    case KernelOp::MinEigenvalue:
    case KernelOp::MinEigenvector:
      return 300;
    default:
      return rows;
  }
}

std::string register_text(const Kernel& kernel, const Register& r, std::uint32_t uniform_begin) {
  if (r.uniform) return fmt::format("u{}", (r.offset - uniform_begin) / kUniformLanes);
  return fmt::format("r{}", r.offset / kernel.lanes);
}

/// Where the uniform registers begin: they are kept after all others.
std::uint32_t first_uniform(const Kernel& kernel) {
  std::uint32_t first = kernel.doubles;
  for (const KernelConstant& constant : kernel.constants)
    first = std::min(first, constant.place.offset);
  for (const KernelInstruction& instruction : kernel.once)
    if (instruction.d.rows != 0) first = std::min(first, instruction.d.offset);
  return first;
}

std::string line(const Kernel& kernel, const KernelInstruction& i, std::uint32_t uniform_begin) {
  std::string text;
  if (i.op == KernelOp::Store) {
    text = fmt::format("out{} = ", i.numbers[0]);
  } else {
    text = fmt::format("{}.{} = ", register_text(kernel, i.d, uniform_begin), i.d.rows);
  }
  text += name_of(i.op);
  if (i.op == KernelOp::Gather) text += fmt::format(" in{}", i.numbers[0]);
  if (i.op == KernelOp::GatherDifference)
    text += fmt::format(" in{} in{}", i.numbers[0], i.numbers[1]);
  for (int k = 0; k < operand_count(i.op); ++k)
    text += ' ' + register_text(kernel, i.operands[k], uniform_begin);
  if (i.op == KernelOp::WholePow)
    text += fmt::format(" {}", static_cast<std::int32_t>(i.numbers[0]));
  return text + '\n';
}

}  // namespace

std::string_view name_of(KernelOp op) {
  return kOps[static_cast<std::size_t>(op)].name;
}
int operand_count(KernelOp op) {
  return kOps[static_cast<std::size_t>(op)].operands;
}

std::uint32_t Kernel::operations() const {
  std::uint32_t sum = 0;
  for (const KernelInstruction& instruction : code) sum += cost(instruction);
  return sum;
}

std::uint32_t Kernel::bytes() const {
  std::uint32_t numbers = 0;
  for (const KernelInput& in : inputs)
    if (!in.uniform) numbers += types::component_count({in.type, {}});
  for (const KernelOutput& out : outputs)
    numbers += out.type == ir::ValueKind::Bool ? 1 : types::component_count({out.type, {}});
  return numbers * static_cast<std::uint32_t>(sizeof(double));
}

std::string to_string(const Kernel& kernel) {
  const std::uint32_t uniform_begin = first_uniform(kernel);
  std::string text;
  for (const KernelConstant& constant : kernel.constants)
    text += fmt::format("{}.{} = {}\n", register_text(kernel, constant.place, uniform_begin),
                        constant.place.rows, constant.value);
  for (const KernelInstruction& instruction : kernel.once)
    text += "once " + line(kernel, instruction, uniform_begin);
  for (const KernelInstruction& instruction : kernel.code)
    text += line(kernel, instruction, uniform_begin);
  return text;
}

}  // namespace gmsim::compile
