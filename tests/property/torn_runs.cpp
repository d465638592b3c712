// SPDX-License-Identifier: MIT
// Random bodies of all kinds of elements tear by random criteria and operations. After every step
// the simulation, which follows tears locally, equals one that is made anew from the state: motion,
// events, masses, energies and the values of all criteria, bit by bit.
//   torn_runs [--runs N] [--seed S]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "engine/simulation.h"
#include "gmap/validate.h"
#include "scene/scene.h"

using namespace gmsim;

namespace {

constexpr int kSteps = 8;

/// Changes of values alone.
constexpr const char* kDamage = R"(
operation weaken on halfedge(a) { a.stretch_spring.stiffness = 0.5 * a.stretch_spring.stiffness; }
operation erode on vertex(a) {
    for c in vertex(a) / corner { c.corner_mass = 0.9 * c.corner_mass; }
    a.velocity = 0.5 * a.velocity;
}
)";

struct Mesh {
  int dimension;
  const char* text;
};
constexpr Mesh kMeshes[] = {
    {2, "grid: { patches: [4, 3], size: [1, 0.8], cells: quads }"},
    {2, "grid: { patches: [3, 3], size: [1, 1], cells: triangles }"},
    {2, "grid: { patches: [2, 3], size: [1, 1], cells: tri4 }"},
    {2, "grid: { patches: [3, 3], size: [1, 1], cells: mix2 }"},
    {2, "grid: { patches: [3, 2], size: [1, 1], cells: mix4 }"},
    {3, "box: { cells: [2, 2, 2], size: [1, 1, 1], elements: hexes }"},
    {3, "box: { cells: [2, 1, 1], size: [1, 1, 1], elements: tets5 }"},
    {3, "box: { cells: [2, 1, 1], size: [1, 1, 1], elements: tets6 }"},
    // two prisms, a hexahedron on one of their quads, a pyramid on another, a tetrahedron on it
    {3, "points: [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1],"
        "[2,0,0],[2,1,0],[2,0,1],[2,1,1],[-1,0.5,0.5],[-0.5,0.5,2]]\n"
        "      cells: [[0,1,2,4,5,6],[0,2,3,4,6,7],[1,8,9,2,5,10,11,6],[0,3,7,4,12],[4,7,12,13]]"},
};

/// A model that tears.
class Model {
 public:
  explicit Model(std::uint64_t seed) : random_(seed), mesh_(kMeshes[seed % std::size(kMeshes)]) {
    text_ = fmt::format("dimension: {}\nrules: [springs, loads, criteria, tear, damage.rule]\nseed: {}\n",
                        mesh_.dimension, seed);
    text_ += fmt::format("bodies:\n  - name: body\n    mesh:\n      {}\n    mass: 0.1\n",
                         mesh_.text);
    interactions();
    text_ += fmt::format("    initial: [ {{ where: \"true\", position: \"{:.3f} * position + {:.3f} * "
                         "(position.y, position.z, position.x)\" }} ]\n",
                         number(1.02, 1.3), number(0, 0.2));
    text_ += "gravity: [0.3, -2, -9.81]\n";
    if (chance(0.5)) text_ += "loads: [ { pressure: { value: 0.7 } } ]\n";
    if (chance(0.6)) text_ += "fix: [ { where: \"position.y < 0.01\" } ]\n";
    if (chance(0.4))
      text_ += "move: [ { where: \"position.y > 0.79\", velocity: [\"0.1\", \"1\", \"0\"] } ]\n";
    tears();
    text_ += fmt::format("integrator: {{ method: {}, dt: 1e-4, on_unstable: warn }}\nduration: 1\n",
                         chance(0.5) ? "rk4" : chance(0.5) ? "velocity_verlet" : "symplectic_euler");
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Gives the lines of `tear:` these thresholds.
  void set_thresholds(const std::vector<double>& thresholds) {
    std::size_t at = 0;
    for (const double threshold : thresholds) {
      at = text_.find("threshold: ", at) + std::string_view("threshold: ").size();
      text_.replace(at, text_.find(',', at) - at, fmt::format("{:.9g}", threshold));
    }
  }

 private:
  bool chance(double part) { return number(0, 1) < part; }
  double number(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  std::string one_of(const std::vector<std::string>& all) { return all[random_() % all.size()]; }

  void interactions() {
    text_ += "    interactions:\n";
    text_ += chance(0.5) ? "      stretch_spring: { stiffness: 60, damping: 0.1 }\n"
                         : "      stretch_spring: { stiffness: \"if random(3, halfedge(a)) < 0.5 then 30 else 60\", "
                           "damping: 0.05 }\n";
    if (mesh_.dimension == 3) {
      if (chance(0.7)) add("shear_spring_3d", "{ stiffness: 40, damping: 0.05 }");
      return;
    }
    if (chance(0.7)) add("linear_shear_spring", "{ stiffness: 43, damping: 0.1 }");
    if (chance(0.5)) add("angular_shear_spring", "{ stiffness: 0.2 }");
    if (chance(0.7)) add("linear_bending_spring", "{ stiffness: 10, damping: 0.1 }");
    if (chance(0.4)) add("angular_bending_spring", "{ stiffness: 0.1 }");
  }
  void add(const std::string& name, const std::string& parameters) {
    there_.push_back(name);
    text_ += fmt::format("      {}: {}\n", name, parameters);
  }
  [[nodiscard]] bool has(const std::string& name) const {
    return std::find(there_.begin(), there_.end(), name) != there_.end();
  }

  void tears() {
    const std::vector<std::string> at_facets{"separate_elements", "remove_element"};
    const std::vector<std::string> at_edges{"remove_edge_elements", "split_edge_ends",
                                            "separate_elements", "remove_element", "weaken"};
    const std::vector<std::string> at_vertices{"split_vertex", "split_vertex", "erode"};
    std::vector<std::pair<std::string, std::vector<std::string>>> choices{
        {"atomic_facet_force", at_facets}, {"global_facet_force", at_facets},
        {"facet_traction", at_facets},     {"atomic_vertex_force", at_vertices},
        {"corner_force", at_vertices},      {"vertex_force", at_vertices},
        {"spring_elongation", at_edges},   {"spring_force", at_edges}};
    if (has("linear_shear_spring")) choices.push_back({"linear_shear_elongation", {"remove_element"}});
    if (has("linear_bending_spring")) choices.push_back({"linear_bending_force", at_facets});
    text_ += "tear:\n";
    const std::size_t count = 1 + random_() % 3;
    for (std::size_t k = 0; k < count; ++k) {
      const auto& [criterion, operations] = choices[random_() % choices.size()];
      text_ += fmt::format("  - {{ when: {}, threshold: 1, do: {}{}{}{} }}\n", criterion,
                           one_of(operations),
                           chance(0.7) ? fmt::format(", at_most: {}", 1 + random_() % 3) : "",
                           chance(0.2) ? ", refresh: true" : "",
                           chance(0.2) ? ", where: \"position.x > 0.3\"" : "");
    }
  }

  std::mt19937_64 random_;
  const Mesh& mesh_;
  std::vector<std::string> there_;
  std::string text_;
};

/// A scene and its simulation.
class Run {
 public:
  explicit Run(const std::filesystem::path& path, unsigned threads = 1) : threads_(threads) {
    scene_ = scene::load_scene(path, {}, sources_, diagnostics_);
    if (scene_) create();
  }
  void create() {
    simulation_ = engine::Simulation::create(*scene_->state, scene_->model, scene_->integrator,
                                             {.threads = threads_}, diagnostics_);
  }
  /// Finds everything anew in the state, or puts another simulation in place of this one. Moved
  /// vertices are known by darts that may be gone, so that these simulations go on.
  void make_anew() {
    simulation_->sync();
    if (!scene_->model.motions.empty()) {
      if (!simulation_->refresh(diagnostics_)) simulation_.reset();
    } else {
      create();
    }
  }
  [[nodiscard]] bool good() const { return scene_ && simulation_; }
  engine::Simulation& simulation() { return *simulation_; }
  engine::State& state() { return *scene_->state; }
  std::optional<engine::StepReport> step() { return simulation_->step(1e9, diagnostics_); }
  /// Ratios of value and threshold of each line of `tear:`, ascending.
  std::vector<std::vector<double>> ratios() {
    std::vector<std::vector<double>> all;
    if (const auto reports = simulation_->survey(diagnostics_))
      for (const auto& report : *reports) {
        all.push_back(report.ratios);
        std::sort(all.back().begin(), all.back().end());
      }
    return all;
  }
  [[nodiscard]] std::string error() const {
    for (const support::Diagnostic& diagnostic : diagnostics_.all())
      if (diagnostic.severity == support::Severity::Error) return diagnostic.message;
    return {};
  }

 private:
  const unsigned threads_;
  support::SourceMap sources_;
  support::Diagnostics diagnostics_;
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<engine::Simulation> simulation_;
};

bool same(const engine::TearEvent& a, const engine::TearEvent& b) {
  return a.step == b.step && a.time == b.time && a.pairing == b.pairing && a.value == b.value &&
         a.threshold == b.threshold && a.dart == b.dart && a.position == b.position &&
         a.split == b.split && a.created == b.created && a.removed == b.removed;
}

/// What differs between two simulations after a step; empty when nothing does.
std::string difference(const engine::StepReport& a, const engine::StepReport& b, Run& kept,
                       Run& anew) {
  if (a.events.size() != b.events.size()) return "number of events";
  for (std::size_t k = 0; k < a.events.size(); ++k)
    if (!same(a.events[k], b.events[k])) return fmt::format("event {}", k);
  if (a.dropped != b.dropped) return "dropped requests";
  if (kept.simulation().state_hash() != anew.simulation().state_hash()) return "motion";
  const engine::Totals p = kept.simulation().totals(), q = anew.simulation().totals();
  if (p.mass != q.mass || p.kinetic != q.kinetic || p.potential != q.potential ||
      p.momentum != q.momentum)
    return "totals";
  return {};
}

class Trials {
 public:
  Trials() {
    folder_ = std::filesystem::temp_directory_path() / fmt::format("gmsim_torn_{}", ::getpid());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "damage.rule") << kDamage;
    path_ = folder_ / "body.yaml";
  }
  ~Trials() { std::filesystem::remove_all(folder_); }

  /// False after a difference, which is printed.
  bool run(std::uint64_t seed) {
    Model model(seed);
    std::ofstream(path_) << model.text();
    std::mt19937_64 random(seed + 1);
    Run first(path_);
    if (!first.good()) return report(seed, model, 0, first.error());
    model.set_thresholds(choose_thresholds(first, random));
    std::ofstream(path_) << model.text();
    Run kept(path_, 1 + seed % 2), anew(path_);  // threads change no bit
    if (!kept.good() || !anew.good()) return report(seed, model, 0, kept.error() + anew.error());
    for (int step = 1; step <= kSteps; ++step) {
      const auto a = kept.step(), b = anew.step();
      if (a.has_value() != b.has_value())
        return report(seed, model, step, kept.error() + " / " + anew.error());
      if (!a) break;  // both failed
      events_ += a->events.size();
      const auto broken = gmap::validate(kept.state().map, kept.state().store);
      if (!broken.empty()) return report(seed, model, step, broken.front());
      const std::string differs = difference(*a, *b, kept, anew);
      if (!differs.empty()) return report(seed, model, step, differs);
      anew.make_anew();
      if (!anew.good()) break;  // a vertex lost its mass, say; the other one said so too
      if (a->map_changed && kept.ratios() != anew.ratios())
        return report(seed, model, step, "values of criteria");
    }
    return true;
  }
  [[nodiscard]] std::size_t events() const { return events_; }

 private:
  /// Thresholds that the strongest matches of each line pass now or soon.
  static std::vector<double> choose_thresholds(Run& run, std::mt19937_64& random) {
    std::vector<double> thresholds;
    for (const std::vector<double>& ratios : run.ratios()) {
      const double largest = ratios.empty() || !(ratios.back() > 0) ? 1 : ratios.back();
      thresholds.push_back(std::uniform_real_distribution<double>(0.4, 1.05)(random) * largest);
    }
    return thresholds;
  }
  static bool report(std::uint64_t seed, const Model& model, int step, const std::string& what) {
    fmt::print("seed {}, step {}: {}\n{}\n", seed, step, what, model.text());
    return false;
  }

  std::filesystem::path folder_, path_;
  std::size_t events_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t runs = 18, seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    (option == "--runs" ? runs : seed) = std::strtoull(argv[i + 1], nullptr, 10);
  }
  Trials trials;
  std::uint64_t failed = 0;
  for (std::uint64_t k = 0; k < runs && failed < 3; ++k) failed += trials.run(seed + k) ? 0 : 1;
  fmt::print("{} runs from seed {}, {} tears, {} failed\n", runs, seed, trials.events(), failed);
  if (trials.events() < runs / 2) fmt::print("too little tears\n");
  return failed == 0 && trials.events() >= runs / 2 ? 0 : 1;
}
