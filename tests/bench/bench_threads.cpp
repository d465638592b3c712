// SPDX-License-Identifier: MIT
// What a second thread gains: wall time of a Runge-Kutta step on one and on two threads, beside two
// hand-written cloths that have nothing to do with each other, one on each of two threads.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <thread>

#include "bench/bench_timing.h"
#include "bench/scene_cloth.h"

using namespace gmsim;

namespace {

constexpr double kBar = 0.85;  // of what the probe gains
constexpr const char* kScene = "scenes/paper/table2_quads.yaml";

template <typename Work>
double wall(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Gain {
  double probe = 0, gmsim = 0;
  double alone = 0, shared = 0;  // s per step
};

double fastest(const std::vector<double>& times) {
  return *std::min_element(times.begin(), times.end());
}

Gain measure(std::uint32_t n) {
  const double dt = 0.05 / (double(n) * n);
  const bench::Cloth cloth = bench::paper_cloth(bench::ClothMesh::Quads, n);
  const std::array probes = {bench::scalar_cloth(cloth), bench::scalar_cloth(cloth)};
  bench::SceneCloth one(kScene, n, dt, 1), two(kScene, n, dt, 2);
  const int steps = std::max(1, static_cast<int>(20000 / (n * n)));
  const auto run = [&](auto& stepper) {
    for (int i = 0; i < steps; ++i) stepper(dt);
  };
  const auto probe = [&](int k) { return [&, k](double step) { probes[k]->step(step); }; };
  auto first = probe(0), second = probe(1);
  auto alone = [&](double) { one.step(); };
  auto shared = [&](double) { two.step(); };
  for (int i = 0; i < 8; ++i) run(shared);  // until it has made up its mind about threads
  std::vector<double> a, b, c, d;
  for (int repetition = 0; repetition < (n < 200 ? 31 : 15); ++repetition) {
    a.push_back(wall([&] {
      run(first);
      run(second);
    }));
    b.push_back(wall([&] {
      std::thread other([&] { run(second); });
      run(first);
      other.join();
    }));
    c.push_back(wall([&] { run(alone); }));
    d.push_back(wall([&] { run(shared); }));
  }
  return {fastest(a) / fastest(b), fastest(c) / fastest(d), fastest(c) / steps,
          fastest(d) / steps};
}

}  // namespace

int main() {
  fmt::print("{:>6}{:>14}{:>14}{:>10}{:>10}{:>9}{:>7}\n", "n", "1 thread us", "2 threads us", "gain",
             "probe", "share", "bar");
  bool passed = true;
  for (const std::uint32_t n : {10u, 100u, 300u}) {
    const Gain gain = measure(n);
    // Where threads cannot help, they must not harm.
    const bool ok = n == 10 ? gain.gmsim >= 0.95 : gain.gmsim >= kBar * gain.probe;
    passed = passed && (ok || n == 100);
    fmt::print("{:>6}{:>14.1f}{:>14.1f}{:>10.2f}{:>10.2f}{:>9.2f}{:>7}\n", n, gain.alone * 1e6,
               gain.shared * 1e6, gain.gmsim, gain.probe, gain.gmsim / gain.probe,
               n == 100 ? "" : ok ? "pass" : "MISS");
  }
  return passed ? 0 : 1;
}
