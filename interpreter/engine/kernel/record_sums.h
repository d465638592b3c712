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
  std::uint32_t inner = 0;  ///< so many at its beginning, whose sum may be asked for by itself
};

/// A slot, and whether its record counts negatively.
enum class SignedSlot : std::uint32_t {};
[[nodiscard]] inline SignedSlot signed_slot(std::uint32_t slot, bool negative) {
  return SignedSlot{slot << 1 | (negative ? 1u : 0u)};
}
[[nodiscard]] inline std::uint32_t number_of(SignedSlot slot) {
  return static_cast<std::uint32_t>(slot) >> 1;
}
[[nodiscard]] inline bool is_negative(SignedSlot slot) {
  return (static_cast<std::uint32_t>(slot) & 1) != 0;
}

/// A slot, and how much of its record counts.
struct SlotShare {
  std::uint32_t slot = 0;
  double share = 1;
};

/// out[row] := sum of plus or minus records[slots[k]] in the order of the row's list, for the rows of
/// `lists`. Records are 4 doubles at multiples of 32 bytes. `inner`, unless null, gets the sums of the
/// inner parts.
void sum_records(const double* records, const SlotList* lists, const SignedSlot* slots,
                 std::uint32_t rows, double* out, double* inner = nullptr,
                 Isa isa = preferred_isa());
/// out[row] := sum of shares[k].share * records[shares[k].slot], in the same order.
void sum_shares(const double* records, const SlotList* lists, const SlotShare* shares,
                std::uint32_t rows, double* out, Isa isa = preferred_isa());

}  // namespace gmsim::engine
