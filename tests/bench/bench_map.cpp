// SPDX-License-Identifier: MIT
// The map against bare arrays: ns per dart of the mesh before the job, and how many times what the
// hand-written loop takes in the same run. See bare_map.h and map_jobs.h for the jobs.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "bench/bare_map.h"
#include "bench/bench_map_cgal.h"
#include "bench/bench_timing.h"
#include "bench/map_jobs.h"
#include "gmap/mesh_builders.h"
#include "gmap/validate.h"

using namespace gmsim;
using namespace gmsim::bench;

namespace {

constexpr std::uint32_t kSide = 300;

/// A job with the largest ratio to the bare loop that passes; 0: reported only.
struct Job {
  const char* name;
  double bar;
};
constexpr std::array<Job, 7> kJobs{{{"construct", 0.0},
                                    {"vertex orbits", 2.0},
                                    {"unsew all, split", 3.0},
                                    {"sew all, mean", 3.0},
                                    {"sew all, keep first", 3.0},
                                    {"cone of every face", 2.0},
                                    {"remove every second", 5.0}}};
enum JobNumber { Construct, Walk, Unsew, SewMean, SewFirst, Cone, Remove };
constexpr double kMemoryBar = 32.0;  // bytes per dart

using Times = std::array<std::vector<double>, kJobs.size()>;

class Comparison {
 public:
  explicit Comparison(const gmap::Mesh& mesh)
      : mesh_(mesh), built_(gmap::build_map(mesh)), bare_built_(bare_construct(mesh)) {}

  void repeat() {
    construct();
    walk();
    unsew_and_sew(SewMean, Merge::Mean);
    unsew_and_sew(SewFirst, Merge::KeepFirst);
    cone();
    remove();
  }
  [[nodiscard]] double darts() const { return built_.map.dart_count(); }
  [[nodiscard]] double bare_ns(std::size_t job) const { return 1e9 * median(bare_[job]) / darts(); }
  [[nodiscard]] double map_ns(std::size_t job) const { return 1e9 * median(map_[job]) / darts(); }
  [[nodiscard]] double bare_bytes() const { return double(bare_built_.memory_bytes()) / darts(); }
  [[nodiscard]] double map_bytes() const {
    Workspace work;
    return double(MapJobs(built_, mesh_.points, work).memory_bytes()) / darts();
  }

 private:
  void add(JobNumber job, double bare, double map) {
    bare_[job].push_back(bare);
    map_[job].push_back(map);
  }
  void check(const BareMap& bare, const MapJobs& jobs) const {
    GMSIM_CHECK(gmap::validate(jobs.map(), jobs.store()).empty(), "the map is wrong after a job");
    for (std::uint32_t i = 0; i < jobs.map().dart_end(); ++i) {
      const gmap::DartId d{i};
      GMSIM_CHECK(jobs.map().alive(d) == (bare.alpha0[i] >= 0), "map and arrays disagree on darts");
      if (!jobs.map().alive(d)) continue;
      const auto value = jobs.store().get(jobs.position(), d);
      const auto& expected = bare.position[static_cast<std::size_t>(bare.vertex[i])];
      for (std::size_t k = 0; k < 3; ++k) {
        GMSIM_CHECK(std::abs(value[k] - expected[k]) < 1e-12,
                    "map and arrays disagree on positions");
      }
    }
  }

  void construct() {
    const double bare = seconds([&] { keep(bare_construct(mesh_)); });
    add(Construct, bare,
        seconds([&] { keep(MapJobs(gmap::build_map(mesh_), mesh_.points, work_)); }));
  }
  void walk() {
    const std::vector<std::int32_t> starts = bare_vertex_darts(bare_built_);
    const MapJobs jobs(built_, mesh_.points, work_);
    std::int64_t bare_sum = 0, map_sum = 0;
    const double bare = seconds([&] { bare_sum = bare_walk(bare_built_, starts); });
    add(Walk, bare, seconds([&] { map_sum = jobs.walk_vertices(); }));
    GMSIM_CHECK(bare_sum == map_sum, "the walks met different darts");
  }
  void unsew_and_sew(JobNumber job, Merge merge) {
    BareMap bare = bare_built_;
    MapJobs jobs(built_, mesh_.points, work_);
    SewnEdges bare_edges;
    MapJobs::Edges edges;
    double bare_time = seconds([&] { bare_edges = bare_unsew_all(bare); });
    add(Unsew, bare_time, seconds([&] { edges = jobs.unsew_all(); }));
    check(bare, jobs);
    if (merge == Merge::Mean) {
      bare_displace(bare);
      jobs.displace();
    }
    bare_time = seconds([&] { bare_sew_all(bare, bare_edges, merge); });
    add(job, bare_time, seconds([&] { jobs.sew_all(edges, merge); }));
    check(bare, jobs);
  }
  void cone() {
    BareMap bare = bare_built_;
    MapJobs jobs(built_, mesh_.points, work_);
    const double bare_time = seconds([&] { bare_cone_all(bare); });
    add(Cone, bare_time, seconds([&] { jobs.cone_all(); }));
    check(bare, jobs);
  }
  void remove() {
    BareMap bare = bare_built_;
    MapJobs jobs(built_, mesh_.points, work_);
    const double bare_time = seconds([&] { bare_remove_every_second(bare); });
    add(Remove, bare_time, seconds([&] { jobs.remove_every_second(); }));
    check(bare, jobs);
  }

  const gmap::Mesh& mesh_;
  gmap::MeshMap built_;
  BareMap bare_built_;
  Workspace work_;
  Times bare_, map_;
};

const char* verdict(double value, double bar) {
  return bar == 0.0 ? "" : value <= bar ? "pass" : "MISS";
}

/// Prints the table of one mesh; true when no bar is missed.
bool report(const std::string& name, const Comparison& results, const CgalTimes& cgal) {
  fmt::print("\n{}: {:.0f} darts\n", name, results.darts());
  fmt::print("  {:<22}{:>10}{:>10}{:>8}{:>7}{:>6}{:>12}\n", "ns per dart", "bare", "map", "ratio",
             "bar", "", "CGAL");
  bool passed = true;
  for (std::size_t job = 0; job < kJobs.size(); ++job) {
    const double ratio = results.map_ns(job) / results.bare_ns(job), bar = kJobs[job].bar;
    passed = passed && (bar == 0.0 || ratio <= bar);
    fmt::print("  {:<22}{:>10.2f}{:>10.2f}{:>8.2f}{:>7}{:>6}{:>12}\n", kJobs[job].name,
               results.bare_ns(job), results.map_ns(job), ratio,
               bar == 0.0 ? "-" : fmt::format("{:.0f}x", bar), verdict(ratio, bar),
               cgal.measured ? fmt::format("{:.1f}", cgal.ns_per_dart[job]) : "-");
  }
  const double bytes = results.map_bytes();
  fmt::print("  {:<22}{:>10.2f}{:>10.2f}{:>8.2f}{:>7}{:>6}{:>12}\n", "bytes per dart",
             results.bare_bytes(), bytes, bytes / results.bare_bytes(),
             fmt::format("{:.0f} B", kMemoryBar), verdict(bytes, kMemoryBar),
             cgal.measured ? fmt::format("{:.0f}", cgal.bytes_per_dart) : "-");
  return passed && bytes <= kMemoryBar;
}

}  // namespace

int main(int argc, char** argv) {
  bool check = false, with_cgal = false;
  int repetitions = 11;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--check") {
      check = true;
    } else if (argument == "--cgal") {
      with_cgal = true;
    } else if (argument == "--repetitions" && i + 1 < argc) {
      repetitions = std::max(1, std::atoi(argv[++i]));
    } else {
      fmt::print(
          "usage: bench_map [--check] [--cgal] [--repetitions N]\n"
          "  --check  exit with 1 when a bar is missed\n"
          "  --cgal   measure CGAL's Generalized_map beside, when built with it\n");
      return argument == "--help" || argument == "-h" ? 0 : 2;
    }
  }
  keep_memory();
  bool passed = true;
  for (auto [name, cells] : {std::pair{"quads 300 x 300", gmap::GridCells::Quads},
                             std::pair{"triangles 300 x 300", gmap::GridCells::Triangles}}) {
    const gmap::Mesh mesh = gmap::grid(kSide, kSide, 1.0, 1.0, cells);
    Comparison comparison(mesh);
    for (int k = 0; k < repetitions; ++k) comparison.repeat();
    passed &= report(name, comparison, with_cgal ? measure_cgal(mesh, repetitions) : CgalTimes{});
  }
  return check && !passed ? 1 : 0;
}
