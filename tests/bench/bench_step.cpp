// SPDX-License-Identifier: MIT
// Microseconds per Runge-Kutta step of the paper's cloth: scenes run by gmsim beside the
// hand-written programs of yardstick.h, in one run on one machine, with the same positions at the
// end.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "bench/bench_timing.h"
#include "bench/scene_cloth.h"
#include "bench/yardstick.h"
#include "engine/kernel/run_kernel.h"

using namespace gmsim;
using bench::SceneCloth;

namespace {

constexpr double kBar = 1.0;  // times the hand-written scalar program

struct Mesh {
  const char* name;
  const char* scene;
  bench::ClothMesh yardstick;
};

struct Times {
  double scalar = 0, merged = 0, simd = 0, gmsim = 0;  // s per step
  double distance = 0;                                 // m, between gmsim and scalar
};

template <typename Step>
double per_step(int steps, const Step& step) {
  return bench::seconds([&] {
           for (int i = 0; i < steps; ++i) step();
         }) /
         steps;
}

Times measure(const Mesh& mesh, std::uint32_t n) {
  const double dt =
      0.05 / (double(n) * n);  // the limit of damping falls with the square of a patch
  const bench::Cloth cloth = bench::paper_cloth(mesh.yardstick, n);
  const auto scalar = bench::scalar_cloth(cloth), merged = bench::merged_cloth(cloth),
             simd = bench::simd_cloth(cloth);
  SceneCloth gmsim(mesh.scene, n, dt, 1);
  const int steps = std::max(1, static_cast<int>(20000 / (n * n)));
  std::vector<double> a, b, c, d;
  for (int repetition = 0; repetition < (n < 200 ? 31 : 11); ++repetition) {
    a.push_back(per_step(steps, [&] { scalar->step(dt); }));
    b.push_back(per_step(steps, [&] { merged->step(dt); }));
    c.push_back(per_step(steps, [&] { simd->step(dt); }));
    d.push_back(per_step(steps, [&] { gmsim.step(); }));
  }
  return {bench::median(a), bench::median(b), bench::median(c), bench::median(d),
          gmsim.distance(*scalar)};
}

}  // namespace

/// bench_step [largest n [mesh]]
int main(int argc, char** argv) {
  const std::uint32_t largest = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 300;
  const Mesh meshes[] = {{"quads", "scenes/paper/table2_quads.yaml", bench::ClothMesh::Quads},
                         {"tri4", "scenes/paper/table2_tri4.yaml", bench::ClothMesh::Tri4},
                         {"mix4", "scenes/paper/table2_mix4.yaml", bench::ClothMesh::Mix4}};
  fmt::print("instruction set {}; microseconds a step\n", engine::name_of(engine::preferred_isa()));
  fmt::print("{:8}{:>6}{:>11}{:>11}{:>11}{:>11}{:>9}{:>7}{:>12}\n", "mesh", "n", "scalar", "merged",
             "simd", "gmsim", "ratio", "bar", "distance");
  bool passed = true;
  for (const Mesh& mesh : meshes) {
    for (const std::uint32_t n : {10u, 100u, 300u}) {
      if (n > largest || (argc > 2 && argv[2] != std::string(mesh.name))) continue;
      const Times t = measure(mesh, n);
      const double ratio = t.gmsim / t.scalar;
      passed = passed && ratio <= kBar && t.distance < 1e-9;
      fmt::print("{:8}{:>6}{:>11.2f}{:>11.2f}{:>11.2f}{:>11.2f}{:>9.2f}{:>7}{:>12.1e}\n", mesh.name,
                 n, t.scalar * 1e6, t.merged * 1e6, t.simd * 1e6, t.gmsim * 1e6, ratio,
                 ratio <= kBar ? "pass" : "MISS", t.distance);
    }
  }
  return passed ? 0 : 1;
}
