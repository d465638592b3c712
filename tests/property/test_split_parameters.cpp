// SPDX-License-Identifier: MIT
// Springs on edges that rules cut: what the pieces carry together is what the edge carried.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

#include "engine/rewrite.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using types::DartId;
using types::EmbeddingId;

namespace {

struct Spring {
  double stiffness = 0, rest = 0, fraction = 0;
};

/// A mesh on which random half-edges carry a stretch_spring with random parameters.
class SpringMesh {
 public:
  SpringMesh(const gmap::Mesh& mesh, std::uint64_t seed)
      : rules_("", mesh.dimension, true),
        state_(make_state(rules_.program(), mesh, seed)),
        random_(seed) {
    const std::array<const char*, 5> names = {"stretch_spring", "stretch_spring.stiffness",
                                              "stretch_spring.damping", "stretch_spring.rest",
                                              "stretch_spring.fraction"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      ids_[k] = rules_.embedding(names[k]);
      state_->use(ids_[k]);
    }
    for (const DartId dart : gmap::all_orbits(state_->map, {0})) {
      if (random_() % 3 == 0) continue;
      set(0, dart, 1.0);
      set(1, dart, between(1.0, 9.0));
      set(2, dart, between(0.0, 1.0));
      set(3, dart, between(0.5, 2.0));
      set(4, dart, between(0.25, 1.0));
    }
  }

  [[nodiscard]] engine::State& state() { return *state_; }
  [[nodiscard]] std::mt19937_64& random() { return random_; }
  [[nodiscard]] const compile::Rule& rule(const char* name) const { return rules_.rule(name); }
  [[nodiscard]] bool carries(DartId dart) const {
    const auto mark = state_->store.get(ids_[0], dart);
    return !mark.empty() && mark[0] != 0.0;
  }
  [[nodiscard]] Spring spring(DartId dart) const {
    return {value(1, dart), value(3, dart), value(4, dart)};
  }

  /// Sums over all springs: how many there are, rest, fraction.
  [[nodiscard]] std::array<double, 3> totals() const {
    std::array<double, 3> sum{};
    for (const DartId dart : gmap::all_orbits(state_->map, {0})) {
      if (!carries(dart)) continue;
      sum[0] += 1.0;
      sum[1] += value(3, dart);
      sum[2] += value(4, dart);
    }
    return sum;
  }

  void apply(const char* name, DartId dart) {
    engine::Rewriter rewriter(*state_, {.validate = true});
    const engine::RewriteOutcome outcome = rewriter.apply(rule(name), {&dart, 1});
    REQUIRE_MESSAGE(outcome.applied(), (outcome.error ? outcome.error->message : name));
  }

 private:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  void set(std::size_t k, DartId dart, double x) {
    state_->store.set(ids_[k], dart, {&x, 1});
  }
  [[nodiscard]] double value(std::size_t k, DartId dart) const {
    const auto stored = state_->store.get(ids_[k], dart);
    REQUIRE(stored.size() == 1);
    return stored[0];
  }

  RuleBook rules_;
  std::unique_ptr<engine::State> state_;
  std::mt19937_64 random_;
  std::array<EmbeddingId, 5> ids_{};
};

/// A half-edge before it is cut, and between which darts.
struct HalfEdge {
  DartId begin, end;
  bool carries = false;
  Spring spring = {};
};

std::vector<HalfEdge> half_edges(SpringMesh& mesh) {
  std::vector<HalfEdge> all;
  for (const DartId dart : gmap::all_orbits(mesh.state().map, {0})) {
    HalfEdge edge{dart, mesh.state().map.alpha(0, dart), mesh.carries(dart)};
    if (edge.carries) edge.spring = mesh.spring(dart);
    all.push_back(edge);
  }
  return all;
}

/// The pieces of a half-edge, one dart each, in order from its first end.
std::vector<DartId> pieces(const gmap::GMap& map, const HalfEdge& edge) {
  std::vector<DartId> all{edge.begin};
  for (DartId at = map.alpha(0, edge.begin); at != edge.end; at = map.alpha(0, all.back())) {
    all.push_back(map.alpha(1, at));
  }
  return all;
}

/// Springs in series: the same stiffness over the whole, the same rest length, each piece as stiff
/// as it is short.
void check_pieces(const SpringMesh& mesh, const HalfEdge& edge, const std::vector<DartId>& parts) {
  double rest = 0, fraction = 0, compliance = 0;
  for (const DartId part : parts) {
    REQUIRE(mesh.carries(part) == edge.carries);
    if (!edge.carries) continue;
    const Spring piece = mesh.spring(part);
    rest += piece.rest;
    fraction += piece.fraction;
    compliance += piece.fraction / piece.stiffness;
    CHECK(piece.stiffness == edge.spring.stiffness);
    CHECK(piece.stiffness / piece.fraction * piece.rest ==
          doctest::Approx(edge.spring.stiffness / edge.spring.fraction * edge.spring.rest)
              .epsilon(1e-14));
  }
  if (!edge.carries) return;
  CHECK(rest == doctest::Approx(edge.spring.rest).epsilon(1e-14));
  CHECK(fraction == doctest::Approx(edge.spring.fraction).epsilon(1e-14));
  CHECK(compliance == doctest::Approx(edge.spring.fraction / edge.spring.stiffness).epsilon(1e-14));
}

void cut_at_random(const gmap::Mesh& mesh, std::uint64_t seed) {
  CAPTURE(seed);
  SpringMesh springs(mesh, seed);
  const std::vector<HalfEdge> before = half_edges(springs);
  for (int k = 0; k < 25; ++k) {
    DartId dart;
    do {
      dart = DartId{static_cast<std::uint32_t>(springs.random()() % springs.state().map.dart_end())};
    } while (!springs.state().map.alive(dart));
    springs.apply("insert_vertex", dart);
  }
  std::size_t cut = 0;
  for (const HalfEdge& edge : before) {
    const std::vector<DartId> parts = pieces(springs.state().map, edge);
    cut += parts.size() > 1 && edge.carries;
    check_pieces(springs, edge, parts);
  }
  CHECK(cut > 0);
}

}  // namespace

TEST_CASE("an edge cut again and again carries its spring in series") {
  const std::uint64_t seed = std::random_device{}();
  cut_at_random(gmap::grid(3, 2, 1.0, 1.0, gmap::GridCells::Quads), seed);
  cut_at_random(gmap::grid(2, 2, 1.0, 1.0, gmap::GridCells::Mix4), seed + 1);
  cut_at_random(gmap::box({2, 1, 1}, {1.0, 1.0, 1.0}, gmap::BoxElements::Hexes), seed + 2);
  cut_at_random(gmap::box({1, 1, 1}, {1.0, 1.0, 1.0}, gmap::BoxElements::Tets5), seed + 3);
}

TEST_CASE("refining cuts every spring in two, and new edges carry none") {
  const std::uint64_t seed = std::random_device{}();
  CAPTURE(seed);
  for (const char* name : {"subdivide_quads", "subdivide_triangles"}) {
    CAPTURE(name);
    const bool quads = std::string(name) == "subdivide_quads";
    SpringMesh springs(gmap::grid(3, 2, 1.0, 1.0,
                                  quads ? gmap::GridCells::Quads : gmap::GridCells::Triangles),
                       seed);
    const auto before = springs.totals();
    springs.apply(name, DartId{0});
    const auto after = springs.totals();
    CHECK(after[0] == 2 * before[0]);
    CHECK(after[1] == doctest::Approx(before[1]).epsilon(1e-13));
    CHECK(after[2] == doctest::Approx(before[2]).epsilon(1e-13));
  }
}

TEST_CASE("tearing leaves springs as they are") {
  const std::uint64_t seed = std::random_device{}();
  CAPTURE(seed);
  SpringMesh springs(gmap::grid(4, 3, 1.0, 1.0, gmap::GridCells::Mix2), seed);
  const std::vector<HalfEdge> before = half_edges(springs);
  const std::uint32_t darts = springs.state().map.dart_end();
  for (std::uint32_t d = 0; d < darts; ++d) {
    if (springs.state().map.is_free(2, DartId{d})) continue;
    springs.apply("separate_elements", DartId{d});
  }
  for (const HalfEdge& edge : before) {
    REQUIRE(springs.carries(edge.begin) == edge.carries);
    if (!edge.carries) continue;
    const Spring now = springs.spring(edge.begin);
    CHECK(now.stiffness == edge.spring.stiffness);
    CHECK(now.rest == edge.spring.rest);
    CHECK(now.fraction == edge.spring.fraction);
  }
}
