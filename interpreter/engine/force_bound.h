// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/force_context.h"
#include "engine/force_field.h"

namespace gmsim::engine {

/// An upper bound of the largest eigenvalue of a global matrix against the masses, from the matrices
/// of single matches, that stays one when elements are torn apart.
///
/// Matches that stand on the corners of one element are added up; others (a spring across an edge)
/// stay alone. Each of these pieces gets a share of every corner mass it stands on, in proportion to
/// how stiff it is there, so that no mass is counted twice. With K = sum K_g and M >= sum M_g the
/// largest eigenvalue of (K, M) is at most the largest of all (K_g, M_g), since x'K_g x <= l_g x'M_g x
/// for each. When two corners part, both sides of every inequality keep their terms.
class ElementBounds {
 public:
  explicit ElementBounds(const ForceContext& context);

  /// What a match stands on: of each force root the smallest darts of its corners. Empty entries
  /// are vertices that do not move.
  struct Stand {
    std::vector<std::vector<DartId>> corners;  ///< by force root
    DartId element = gmap::kNoDart;            ///< kNoDart: not within one element
  };
  /// `targets`: the dart of each of Shape::targets.
  [[nodiscard]] Stand stand(const compile::Shape& shape, std::span<const DartId> targets) const;
  /// `matrix`: 3 n by 3 n by rows, n = force roots of the match; its symmetric part counts.
  void add(std::uint32_t interaction, DartId where, const Stand& stand,
           std::span<const double> matrix);

  struct Largest {
    double value = 0;
    DartId where = gmap::kNoDart;   ///< of the stiffest match of the piece
    std::uint32_t interaction = 0;  ///< index into Program::interactions
  };
  /// Infinite where something stiff stands on no mass.
  [[nodiscard]] Largest largest() const;

 private:
  struct Piece {
    std::vector<std::vector<DartId>> places;  // a place of three degrees of freedom: its corners
    std::vector<double> matrix;               // by rows
    double stiffest = 0;
    DartId where = gmap::kNoDart;
    std::uint32_t interaction = 0;
  };
  [[nodiscard]] double mass(DartId corner) const;
  static std::size_t place(Piece& piece, const std::vector<DartId>& corners);
  /// How stiff a piece is at a place: the norm of its three rows.
  static double weight(const Piece& piece, std::size_t place);
  /// By smallest dart of the corner: the sum over all pieces.
  [[nodiscard]] std::vector<double> total_weights() const;
  /// The largest eigenvalue of a piece, or `known` when that is not smaller.
  [[nodiscard]] double eigenvalue(const Piece& piece,
                                  const std::vector<double>& totals, double known) const;

  const ForceContext& context_;
  std::optional<EmbeddingId> corner_mass_;
  std::optional<EmbeddingId> fixed_;
  OrbitType corner_, element_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> of_element_;  // piece by smallest dart
};

/// Largest eigenvalue of a symmetric matrix (n by n, by rows), by Jacobi rotations.
[[nodiscard]] double largest_eigenvalue(std::vector<double> matrix, std::size_t n);

}  // namespace gmsim::engine
