// SPDX-License-Identifier: MIT
// The cloth of Fig. 14 of the paper in hand-written C++: what gmsim's speed is measured against,
// and an independent program for its trajectories.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace gmsim::bench {

/// All patches quads; each patch a cone of four triangles; half of them in turn, like a chess
/// board.
enum class ClothMesh { Quads, Tri4, Mix4 };

/// On i: (stiffness (l - rest) + damping (dv . d)/l) d/l with d = x_j - x_i, dv = v_j - v_i, l =
/// |d|; the opposite on j.
struct ClothSpring {
  std::uint32_t i = 0, j = 0;
  double stiffness = 0;  // N/m
  double rest = 0;       // m
  double damping = 0;    // N s/m
};

/// An inner edge between two faces; the first has it from `a` to `b`. Corner k of a face is number
/// first + k, where the corners of all faces are counted one after another.
struct ClothEdge {
  std::uint32_t a = 0, b = 0;
  std::array<std::uint32_t, 2> face{}, corner_a{}, corner_b{};  // of both sides
};

/// A square of 1 m by 1 m and 0.1 kg, n by n patches, at rest in the plane z = 0 with two corners
/// fixed. Vertex j (n + 1) + i is at (i, j)/n; tips of cones follow. Stretch springs (60 N/m) lie
/// on the edges of each face, so that inner edges have two; shear springs (43 N/m) on the diagonals
/// of quads; bending springs (10 N/m) join the neighbours of each end of an inner edge in its two
/// faces. All are damped along their direction with 0.1 N s/m.
struct Cloth {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::uint32_t>> faces;
  std::vector<double> mass;  // kg: a face's by area, in equal parts to its corners
  std::vector<std::uint32_t> fixed;
  std::vector<ClothSpring> springs;
  std::vector<std::array<std::uint32_t, 2>> spring_corners;  // where each spring's forces live
  std::vector<ClothEdge> edges;                              // inner ones
};
[[nodiscard]] Cloth paper_cloth(ClothMesh mesh, std::uint32_t n);

/// Springs between the same vertices added up.
[[nodiscard]] std::vector<ClothSpring> merged(const std::vector<ClothSpring>& springs);

/// Steps of the classical Runge-Kutta method under gravity (0, 0, -9.81).
class ClothStepper {
 public:
  virtual ~ClothStepper() = default;
  virtual void step(double dt) = 0;
  [[nodiscard]] virtual std::array<double, 3> position(std::uint32_t vertex) const = 0;
};

/// What tears edges (paper, 5.3): the sum of forces on both ends across the edge (eq. 5), or what the
/// two faces pull it apart by, where each pulls towards itself (eq. 4).
enum class EdgeCriterion { Global, Atomic };

/// A cloth that judges each inner edge on the state that a step begins with, from the forces of its
/// first stage.
class JudgingCloth : public ClothStepper {
 public:
  /// Edges above the threshold so far.
  [[nodiscard]] virtual std::uint64_t fired() const = 0;
  /// The values of all edges now; 0 where the faces do not pull the edge apart.
  [[nodiscard]] virtual std::vector<double> values() = 0;
};

/// One record for each spring of the model, structures of a vertex side by side.
[[nodiscard]] std::unique_ptr<ClothStepper> scalar_cloth(const Cloth& cloth);
/// The same with a criterion; for the atomic one, the first stage keeps the force of every spring.
[[nodiscard]] std::unique_ptr<JudgingCloth> scalar_cloth(const Cloth& cloth, EdgeCriterion criterion,
                                                         double threshold);
/// The same code on merged springs.
[[nodiscard]] std::unique_ptr<ClothStepper> merged_cloth(const Cloth& cloth);
/// Eight merged springs at a time; position and velocity of a vertex in one line of the cache.
[[nodiscard]] std::unique_ptr<ClothStepper> simd_cloth(const Cloth& cloth);

}  // namespace gmsim::bench
