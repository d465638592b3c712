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

/// One record for each spring of the model, structures of a vertex side by side.
[[nodiscard]] std::unique_ptr<ClothStepper> scalar_cloth(const Cloth& cloth);
/// The same code on merged springs.
[[nodiscard]] std::unique_ptr<ClothStepper> merged_cloth(const Cloth& cloth);
/// Eight merged springs at a time; position and velocity of a vertex in one line of the cache.
[[nodiscard]] std::unique_ptr<ClothStepper> simd_cloth(const Cloth& cloth);

}  // namespace gmsim::bench
