// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <utility>

#include "check/known_links.h"

namespace gmsim::check {

/// A dart as an expression of a rule names it: from the dart of a node of the match in a row, a
/// walk over links of which nothing is known. Or from something else that is a dart (the variable
/// of a fold), numbered by the user of this header.
struct SymbolicDart {
  bool of_match = true;
  std::uint32_t base = 0;  ///< node of KnownLinks, or the number of the other thing
  Word rows;               ///< from the row that is looked at, of_match only
  Word walk;
  auto operator<=>(const SymbolicDart&) const = default;
};

/// Walking with the laws of a map: alpha_i alpha_i = 1, alpha_i alpha_j = alpha_j alpha_i for
/// i + 2 <= j, and the known links around a match.
class DartAlgebra {
 public:
  explicit DartAlgebra(const KnownLinks& links)
      : links_(links), walks_(InvolutionGroup::walks(links.dimension())) {}

  [[nodiscard]] SymbolicDart node(NodeIndex node) const { return {true, node, {}, {}}; }
  [[nodiscard]] SymbolicDart other(std::uint32_t number) const { return {false, number, {}, {}}; }
  [[nodiscard]] SymbolicDart walk(SymbolicDart dart, int dimension) const;
  /// The same dart seen from the row that the generator of a label position leads to.
  [[nodiscard]] SymbolicDart from_next_row(SymbolicDart dart, std::uint8_t position) const;
  /// One dart for all of an orbit: equal for darts of one orbit, as far as the laws tell.
  [[nodiscard]] SymbolicDart representative(const SymbolicDart& dart, types::OrbitType type) const;
  /// One dart for all that even walks over 0 and 1 reach, or that odd walks do (then true): the
  /// two directions around a face.
  [[nodiscard]] std::pair<SymbolicDart, bool> around_face(const SymbolicDart& dart) const;

 private:
  [[nodiscard]] bool absorb(SymbolicDart& dart) const;
  [[nodiscard]] std::pair<SymbolicDart, bool> least(const SymbolicDart& dart,
                                                    types::OrbitType type) const;

  const KnownLinks& links_;
  InvolutionGroup walks_;
};

}  // namespace gmsim::check
