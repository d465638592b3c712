// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compile/ir.h"

/// Register programs: what a graph computes, as a list of instructions that each work on a block of
/// matches. Plain data; engine/kernel runs them.
namespace gmsim::compile {

enum class KernelOp : std::uint8_t {
#define KERNEL_OP(id, name, operands, meaning) id,
#include "compile/kernel_ops.def"
#undef KERNEL_OP
};
[[nodiscard]] std::string_view name_of(KernelOp op);
[[nodiscard]] int operand_count(KernelOp op);

/// Doubles that every lane group of a uniform register holds: the widest vector there is.
inline constexpr std::uint32_t kUniformLanes = 8;

/// A register, or some rows of one: a row has `Kernel::lanes` doubles, or kUniformLanes when it is
/// the same for all matches. A number or mask (0 or 1) has one row, a vec3 3, a sym3 6, a mat3 9.
struct Register {
  std::uint32_t offset = 0;  ///< of its first row in the register file, in doubles
  std::uint8_t rows = 0;
  bool uniform = false;
  bool operator==(const Register&) const = default;
};

struct KernelInstruction {
  KernelOp op{};
  ir::ValueKind type =
      ir::ValueKind::Real;  ///< of what is moved, or of the operand whose type varies
  Register d;
  Register operands[3] = {};
  std::uint32_t numbers[2] = {};  ///< inputs, output, exponent (as a signed number)
  ir::Span span = {};
};

struct KernelInput {
  std::uint32_t input = 0;  ///< number in graph.inputs()
  ir::ValueKind type = ir::ValueKind::Real;
  bool uniform = false;  ///< time, dt, step: the same for all matches
};

struct KernelOutput {
  ir::NodeId root{};
  ir::ValueKind type = ir::ValueKind::Real;
};

/// A uniform register that holds a number all the time.
struct KernelConstant {
  Register place;
  double value = 0;
};

struct Kernel {
  std::vector<KernelInput> inputs;    ///< the live ones, by ascending number
  std::vector<KernelOutput> outputs;  ///< one per root, in the order of the roots
  std::vector<KernelConstant> constants;
  std::vector<KernelInstruction> once;  ///< once a run: reads and writes uniform registers only
  std::vector<KernelInstruction> code;  ///< once a block
  std::uint32_t block = 64;             ///< matches worked on at a time
  std::uint32_t lanes = 64;             ///< block, rounded up to kUniformLanes
  std::uint32_t doubles = 0;            ///< size of the register file

  /// Arithmetic operations a match: one per entry of each result, square roots and divisions
  /// included; coarse operations by their usual count.
  [[nodiscard]] std::uint32_t operations() const;
  /// Bytes gathered and stored a match.
  [[nodiscard]] std::uint32_t bytes() const;
};

struct KernelOptions {
  std::uint32_t block = 0;  ///< 0: chosen from the length of the program
};

/// Only what some root depends on. No root may be kNone.
[[nodiscard]] Kernel compile_kernel(const ir::Graph& graph, std::span<const ir::NodeId> roots,
                                    const KernelOptions& options = {});

/// One instruction a line, registers numbered by their place.
[[nodiscard]] std::string to_string(const Kernel& kernel);

}  // namespace gmsim::compile
