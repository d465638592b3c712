// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/kernel/run_kernel.h"

namespace gmsim::engine {

/// The part of an array of slots that belongs to one row.
struct SlotList {
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
  std::uint32_t capacity = 0;
};

/// out[row] := sum of records[slots[k]] in the order of the row's list, for the rows of `lists`.
/// Records are 4 doubles at multiples of 32 bytes.
void sum_records(const double* records, const SlotList* lists, const std::uint32_t* slots,
                 std::uint32_t rows, double* out, Isa isa = preferred_isa());

}  // namespace gmsim::engine
