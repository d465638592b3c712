// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "types/orbit_type.h"

namespace gmsim::compile {

/// What of a dart: of one that changed, what did; of one that a match rests on, what it rests on. A
/// set of bits. Orbit types share bits where there are too few, so an aspect may stand for more than
/// was meant, never for less.
using Aspects = std::uint32_t;
inline constexpr Aspects kEverything = ~Aspects{0};
inline constexpr Aspects kLife = 1u << 8;       ///< whether the dart is there
inline constexpr Aspects kForceList = 1u << 9;  ///< the atomic forces that live on it

/// The dart's links of these dimensions.
[[nodiscard]] constexpr Aspects links(types::OrbitType dimensions) { return dimensions.bits(); }
/// The same, for numbers that a match knows itself: its shape does not rest on them.
[[nodiscard]] constexpr Aspects links_of_numbers(types::OrbitType dimensions) {
  return Aspects{dimensions.bits()} << 4;
}
inline constexpr Aspects kShape =
    links(types::OrbitType::range(0, types::kMaxDimension)) | kLife | kForceList;

namespace detail {
inline constexpr unsigned kTypeBits = 11;
}
/// The row of its orbit of this type.
[[nodiscard]] constexpr Aspects row_of(types::OrbitType type) {
  return 1u << (10 + type.bits() % detail::kTypeBits);
}
/// The values of its orbit of this type.
[[nodiscard]] constexpr Aspects values_of(types::OrbitType type) {
  return 1u << (10 + detail::kTypeBits + type.bits() % detail::kTypeBits);
}
inline constexpr Aspects kAllValues = ((1u << detail::kTypeBits) - 1) << (10 + detail::kTypeBits);

struct Dependence {
  types::DartId dart = types::kNoDart;
  Aspects what = 0;
};

/// Ascending by `of`, one entry for each with all that is said of it.
template <typename Entry>
void merge_aspects(std::vector<Entry>& entries, types::DartId Entry::* of) {
  if (entries.empty()) return;
  std::sort(entries.begin(), entries.end(),
            [of](const Entry& a, const Entry& b) { return a.*of < b.*of; });
  auto last = entries.begin();
  for (auto next = last + 1; next != entries.end(); ++next) {
    if ((*next).*of == (*last).*of)
      last->what |= next->what;
    else
      *++last = *next;
  }
  entries.erase(last + 1, entries.end());
}

}  // namespace gmsim::compile
