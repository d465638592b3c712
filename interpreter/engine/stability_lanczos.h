// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/force_field.h"

namespace gmsim::engine {

/// out := A in, A symmetric; false when it failed.
using SymmetricOperator =
    std::function<bool(std::span<const VertexRecord> in, std::span<VertexRecord> out)>;

/// The ends of the spectrum of a symmetric operator, with vectors of length 1.
struct SpectrumEnds {
  double largest = 0, smallest = 0;
  std::vector<VertexRecord> top, bottom;
  std::uint32_t products = 0;
  bool known = false;  ///< false: a product failed, or the operator acts on nothing
};

/// Lanczos' method without reorthogonalisation, at most `most_products` / 2 steps: rounding makes
/// it find the largest eigenvalue several times, which does no harm here. A second pass makes the
/// vectors without keeping the basis. Stops when the largest value changes by less than
/// 5e-4 of itself in four steps; it comes from below, typically to within 1e-3.
/// `free[row]` is 0 where the operator has no degrees of freedom. The start is fixed: random signs
/// and lengths from the row number.
[[nodiscard]] SpectrumEnds spectrum_ends(const SymmetricOperator& apply,
                                         std::span<const double> free,
                                         std::uint32_t most_products);

/// The largest eigenvalue after so many steps (products) of Lanczos' method that starts in the rows
/// where `start` is not 0: of the modes in which they take part. Comes from below; 0 when a product
/// failed.
[[nodiscard]] double largest_eigenvalue(const SymmetricOperator& apply,
                                        std::span<const double> start, std::uint32_t steps);

/// Rayleigh quotient v . A v of a vector of length 1.
[[nodiscard]] double rayleigh_quotient(const SymmetricOperator& apply,
                                       std::span<const VertexRecord> vector);

}  // namespace gmsim::engine
