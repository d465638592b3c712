// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "engine/kernel/block_frame.h"

/// What running a program and tracing it share. Not for the units of one instruction set.
namespace gmsim::engine {

inline void execute(const compile::KernelInstruction& in, const OpTable& table, BlockFrame& frame) {
  using types::ValueKind;
  const std::size_t column = in.type == ValueKind::Vec3   ? 1
                             : in.type == ValueKind::Sym3 ? 2
                             : in.type == ValueKind::Mat3 ? 3
                                                          : 0;
  table.code[static_cast<std::size_t>(in.op)][column](in, frame);
}

inline void set_constants(const compile::Kernel& kernel, double* registers) {
  for (const compile::KernelConstant& constant : kernel.constants)
    std::fill_n(registers + constant.place.offset, constant.place.rows * compile::kUniformLanes,
                constant.value);
}

}  // namespace gmsim::engine
