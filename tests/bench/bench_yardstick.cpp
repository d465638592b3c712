// SPDX-License-Identifier: MIT
// Microseconds per Runge-Kutta step of the hand-written cloths. Ratios between them that are far
// from those of other machines would make every comparison with them void: then it fails.
#include <fmt/format.h>

#include <cmath>

#include "bench/bench_timing.h"
#include "bench/yardstick.h"

using namespace gmsim;

namespace {

struct Times {
  double scalar = 0, merged = 0, simd = 0;  // s per step
};

double per_step(bench::ClothStepper& cloth, int steps, double dt) {
  return bench::seconds([&] {
           for (int i = 0; i < steps; ++i) cloth.step(dt);
         }) /
         steps;
}

Times measure(bench::ClothMesh mesh, std::uint32_t n) {
  const bench::Cloth cloth = bench::paper_cloth(mesh, n);
  const auto scalar = bench::scalar_cloth(cloth), merged = bench::merged_cloth(cloth),
             simd = bench::simd_cloth(cloth);
  const double dt =
      0.05 / (double(n) * n);  // the limit of damping falls with the square of a patch
  const int steps = std::max(1, static_cast<int>(200000 / (n * n)));
  std::vector<double> a, b, c;
  for (int repetition = 0; repetition < 15; ++repetition) {
    a.push_back(per_step(*scalar, steps, dt));
    b.push_back(per_step(*merged, steps, dt));
    c.push_back(per_step(*simd, steps, dt));
  }
  return {bench::median(a), bench::median(b), bench::median(c)};
}

bool near(double ratio, double expected) {
  return std::abs(ratio / expected - 1) <= 0.25;
}

}  // namespace

int main() {
  const std::pair<const char*, bench::ClothMesh> meshes[] = {{"quads", bench::ClothMesh::Quads},
                                                             {"tri4", bench::ClothMesh::Tri4},
                                                             {"mix4", bench::ClothMesh::Mix4}};
  fmt::print("{:8}{:>6}{:>12}{:>12}{:>12}{:>10}{:>10}   (microseconds a step)\n", "mesh", "n",
             "scalar", "merged", "simd", "merged/s", "simd/s");
  bool honest = true;
  for (const auto& [name, mesh] : meshes) {
    for (const std::uint32_t n : {10u, 100u, 300u}) {
      const Times times = measure(mesh, n);
      const double merged = times.merged / times.scalar, simd = times.simd / times.scalar;
      fmt::print("{:8}{:>6}{:>12.2f}{:>12.2f}{:>12.2f}{:>10.2f}{:>10.2f}\n", name, n,
                 times.scalar * 1e6, times.merged * 1e6, times.simd * 1e6, merged, simd);
      if (mesh == bench::ClothMesh::Quads && n == 10)
        honest = near(merged, 0.67) && near(simd, 0.42);
    }
  }
  if (!honest) fmt::print("the ratios on quads, n = 10, are not within 25 % of 0.67 and 0.42\n");
  return honest ? 0 : 1;
}
