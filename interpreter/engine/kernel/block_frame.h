// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "compile/kernel.h"
#include "engine/kernel/record_sums.h"
#include "engine/kernel/run_kernel.h"

/// What the operations of all instruction sets share: plain structures and tables of pointers. No
/// inline code may be shared, or the linker could pick a copy that the machine cannot run.
namespace gmsim::engine {

/// One turn through a program: matches begin … begin + count - 1.
struct BlockFrame {
  double* registers = nullptr;
  std::size_t row = 0;     ///< doubles from one row of a register to the next
  std::size_t active = 0;  ///< lanes to compute: count, rounded up to kUniformLanes
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
  const InputBinding* inputs = nullptr;
  const OutputBinding* outputs = nullptr;
  bool finite = true;  ///< cleared by a store of a number that is not
};

using OpKernel = void (*)(const compile::KernelInstruction&, BlockFrame&);

inline constexpr std::size_t kKernelOps = 0
#define KERNEL_OP(id, name, operands, meaning) +1
#include "compile/kernel_ops.def"
#undef KERNEL_OP
    ;

/// The code of each operation for numbers and masks, vec3, sym3, mat3; null where it has none.
struct OpTable {
  OpKernel code[kKernelOps][4] = {};
  void (*sum_slots)(const double* records, const SlotList* lists, const SignedSlot* slots,
                    std::uint32_t rows, double* out, double* inner) = nullptr;
  void (*sum_shares)(const double* records, const SlotList* lists, const SlotShare* shares,
                     std::uint32_t rows, double* out) = nullptr;
};

namespace baseline {
[[nodiscard]] const OpTable& op_table();
}
namespace avx2 {
[[nodiscard]] const OpTable& op_table();
}
namespace avx512 {
[[nodiscard]] const OpTable& op_table();
}

}  // namespace gmsim::engine
