// SPDX-License-Identifier: MIT
// What must hold after any rewrite, with rules of the library on meshes of every kind.
#include <doctest/doctest.h>

#include <numeric>
#include <random>

#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/engine_rules.h"
#include "support/map_oracle.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::tests;
using engine::RewriteOutcome;

namespace {

/// Values of every kind, beside those of the library.
const char* const kData = R"(
embedding shared : real on vertex extensive = 0;
embedding shade  : real on face merge mean = 1;
embedding level  : int on edge merge max = 0;
embedding hint   : vec3 on dart = (0, 0, 1);
)";

/// A value that new vertices do not get and that joined ones may not agree on: rules fail over it
/// when the map is rewritten already.
const char* const kFragile = "embedding fragile : real on vertex merge equal;";

const RuleBook& library(int dimension) {
  static const RuleBook books[] = {{kData, 1, true}, {kData, 2, true}, {kData, 3, true}};
  return books[dimension - 1];
}
const RuleBook& fragile_library(int dimension) {
  static const RuleBook books[] = {{kFragile, 1, true}, {kFragile, 2, true}, {kFragile, 3, true}};
  return books[dimension - 1];
}

class Trial {
 public:
  Trial(const RuleBook& book, const gmap::Mesh& mesh, std::uint64_t seed)
      : rules(book), state(make_state(rules.program(), mesh, seed)),
        rewriter(*state, {.validate = true}), plain(*state), random(seed) {}

  DartId random_dart() {
    DartId d{0};
    do d = DartId{static_cast<std::uint32_t>(random() % state->map.dart_end())};
    while (!state->map.alive(d));
    return d;
  }
  RewriteOutcome apply(const char* rule, const std::vector<DartId>& hooks) {
    return rewriter.apply(rules.rule(rule), hooks);
  }
  /// Applies, which must match or not match, but never fail. Every second time as a program does,
  /// without a record of changes where the rule cannot fail.
  bool try_apply(const char* rule, const std::vector<DartId>& hooks) {
    const bool as_program = random() % 2 == 0 && !rewriter.recording();
    const RewriteOutcome outcome =
        as_program ? plain.apply(rules.rule(rule), hooks) : apply(rule, hooks);
    if (outcome.error) FAIL_CHECK(rules.rendered(*outcome.error));
    if (as_program) {
      for (const std::string& flaw : gmap::validate(state->map, state->store)) FAIL_CHECK(flaw);
    }
    return outcome.applied();
  }
  [[nodiscard]] double total(const char* name) const {
    const types::EmbeddingId id = rules.embedding(name);
    double sum = 0.0;
    for (DartId d : gmap::all_orbits(state->map, rules.program().schema[id].orbit)) {
      sum += state->store.get(id, d)[0];
    }
    return sum;
  }
  /// The links, and the values that each dart reads.
  [[nodiscard]] std::vector<double> view() const {
    std::vector<double> all;
    for (std::uint32_t i = 0; i < state->map.dart_end(); ++i) {
      const DartId d{i};
      if (!state->map.alive(d)) continue;
      for (int k = 0; k <= state->map.dimension(); ++k) {
        all.push_back(types::index(state->map.alpha(k, d)));
      }
      for (types::EmbeddingId id : state->store.embeddings()) {
        const auto value = state->store.get(id, d);
        all.insert(all.end(), value.begin(), value.end());
      }
    }
    return all;
  }

  const RuleBook& rules;
  std::unique_ptr<engine::State> state;
  engine::Rewriter rewriter;
  engine::Rewriter plain;
  std::mt19937_64 random;
};

/// Rules of one hook that remove nothing, by the dimension of the map.
std::vector<const char*> conserving_rules(int dimension) {
  switch (dimension) {
    case 1: return {"separate_elements", "insert_vertex"};
    case 2: return {"separate_elements", "insert_vertex", "triangulate_face", "split_quad"};
    default: return {"separate_elements", "insert_vertex", "triangulate_face", "cone_volume"};
  }
}

template <typename Body>
void on_every_mesh(std::uint64_t seed, const Body& body) {
  CAPTURE(seed);
  for (const NamedMesh& mesh : mesh_groups()) {
    CAPTURE(mesh.name);
    Trial trial(library(mesh.mesh.dimension), mesh.mesh, seed);
    body(trial);
  }
}

}  // namespace

TEST_CASE("separate and sew again restores links and values exactly") {
  on_every_mesh(11, [](Trial& trial) {
    const int n = trial.state->map.dimension();
    for (int round = 0; round < 6; ++round) {
      const DartId a = trial.random_dart(), b = trial.state->map.alpha(n, a);
      if (a == b) continue;
      const auto darts = trial.state->map.dart_count();
      // Two halves add up exactly; parts of many merges need not.
      const types::EmbeddingId id = trial.rules.embedding("shared");
      for (std::uint32_t d = 0; d < trial.state->map.dart_end(); ++d) {
        trial.state->store.set(id, DartId{d}, std::vector<double>{1.0});
      }
      const std::vector<double> before = trial.view();
      REQUIRE(trial.try_apply("separate_elements", {a}));
      CHECK(!trial.try_apply("separate_elements", {a}));
      CHECK(!trial.try_apply("separate_elements", {b}));
      CHECK(trial.state->map.dart_count() == darts);
      REQUIRE(trial.try_apply("sew_elements", {a, b}));
      CHECK(trial.view() == before);
    }
  });
}

TEST_CASE("what removes nothing leaves the totals of extensive values") {
  int applied = 0;
  on_every_mesh(12, [&](Trial& trial) {
    const double mass = trial.total("corner_mass"), shared = trial.total("shared");
    const auto rules = conserving_rules(trial.state->map.dimension());
    for (int round = 0; round < 25; ++round) {
      const char* rule = rules[trial.random() % rules.size()];
      CAPTURE(rule);
      applied += trial.try_apply(rule, {trial.random_dart()});
      CHECK(trial.total("corner_mass") == doctest::Approx(mass).epsilon(1e-12));
      CHECK(trial.total("shared") == doctest::Approx(shared).epsilon(1e-12));
    }
  });
  CHECK(applied > 250);
}

TEST_CASE("an application that fails after the map was rewritten leaves no trace") {
  int failed = 0;
  constexpr std::uint64_t kSeed = 16;
  CAPTURE(kSeed);
  for (const NamedMesh& mesh : mesh_groups()) {
    CAPTURE(mesh.name);
    Trial trial(fragile_library(mesh.mesh.dimension), mesh.mesh, kSeed);
    const auto rules = conserving_rules(mesh.mesh.dimension);
    for (int round = 0; round < 15; ++round) {
      const std::string before = fingerprint(*trial.state);
      const bool sew = round % 3 == 2;
      const char* rule = sew ? "sew_elements" : rules[trial.random() % rules.size()];
      std::vector<DartId> hooks{trial.random_dart()};
      if (sew) hooks.push_back(trial.random_dart());
      const RewriteOutcome outcome = trial.apply(rule, hooks);
      if (outcome.applied()) continue;
      CHECK(fingerprint(*trial.state) == before);
      CHECK(outcome.effects.touched.empty());
      failed += outcome.status == RewriteOutcome::Status::Failed;
    }
  }
  CHECK(failed > 50);
}

TEST_CASE("a value is divided equally over all parts, however many") {
  const RuleBook rules(
      "embedding value : real on vertex extensive;\n"
      "rule explode(a) { left { a<0,1,2>; } right { a<0,1,_> -2- a; } }",
      2);
  for (const NamedMesh& mesh : mesh_groups()) {
    if (mesh.mesh.dimension != 2) continue;
    CAPTURE(mesh.name);
    const auto state = make_state(rules.program(), mesh.mesh);
    const types::EmbeddingId id = rules.embedding("value");
    std::vector<double> expected(state->map.dart_end());
    for (std::uint32_t d = 0; d < expected.size(); ++d) {
      const auto parts = gmap::quotient(state->map, {1, 2}, {1}, DartId{d}).size();
      expected[d] = state->store.get(id, DartId{d})[0] / static_cast<double>(parts);
    }
    engine::Rewriter rewriter(*state, {.validate = true});
    for (DartId component : gmap::all_orbits(state->map, {0, 1, 2})) {
      REQUIRE(rewriter.apply(rules.rule("explode"), {&component, 1}).applied());
    }
    for (std::uint32_t d = 0; d < expected.size(); ++d) {
      CHECK(state->store.get(id, DartId{d})[0] == doctest::Approx(expected[d]).epsilon(1e-15));
    }
  }
}

TEST_CASE("rolling back restores every bit, wherever a sequence stops") {
  int undone = 0;
  on_every_mesh(13, [&](Trial& trial) {
    const auto rules = conserving_rules(trial.state->map.dimension());
    engine::OperationRunner runner(trial.rewriter);
    for (int round = 0; round < 6; ++round) {
      const std::string before = fingerprint(*trial.state);
      trial.rewriter.begin();
      for (std::uint64_t k = 1 + trial.random() % 6; k > 0; --k) {
        if (trial.random() % 4 == 0) {
          const auto outcome =
              runner.run(trial.rules.operation("remove_element"), trial.random_dart());
          if (!outcome.applied() || trial.state->map.dart_count() == 0) break;
        } else {
          undone += trial.try_apply(rules[trial.random() % rules.size()], {trial.random_dart()});
        }
      }
      trial.rewriter.roll_back();
      CHECK(fingerprint(*trial.state) == before);
      CHECK(gmap::validate(trial.state->map, trial.state->store) == std::vector<std::string>{});
      trial.try_apply("separate_elements", {trial.random_dart()});
    }
  });
  CHECK(undone > 150);
}

TEST_CASE("an element that is removed takes exactly its darts with it") {
  on_every_mesh(14, [](Trial& trial) {
    const int n = trial.state->map.dimension();
    engine::OperationRunner runner(trial.rewriter);
    for (int round = 0; round < 4 && trial.state->map.dart_count() > 0; ++round) {
      const DartId a = trial.random_dart();
      const auto darts = gmap::orbit_darts(trial.state->map, OrbitType::cell(n, n), a);
      const auto before = trial.state->map.dart_count();
      const RewriteOutcome outcome = runner.run(trial.rules.operation("remove_element"), a);
      if (outcome.error) FAIL_CHECK(trial.rules.rendered(*outcome.error));
      REQUIRE(outcome.applied());
      CHECK(trial.state->map.dart_count() == before - darts.size());
      for (DartId d : darts) CHECK(!trial.state->map.alive(d));
    }
  });
}

TEST_CASE("renaming darts renames the result and changes nothing else") {
  on_every_mesh(15, [](Trial& trial) {
    const gmap::GMap& map = trial.state->map;
    const std::uint32_t count = map.dart_end();
    std::vector<std::uint32_t> new_id(count);
    std::iota(new_id.begin(), new_id.end(), 0u);
    std::shuffle(new_id.begin(), new_id.end(), trial.random);
    const auto other = make_state(trial.rules.program(), renamed(map, new_id));
    for (types::EmbeddingId id : other->store.embeddings()) {
      for (std::uint32_t d = 0; d < count; ++d) {
        other->store.set(id, DartId{new_id[d]}, trial.state->store.get(id, DartId{d}));
      }
    }
    engine::Rewriter rewriter(*other, {.validate = true});
    const auto rules = conserving_rules(map.dimension());
    for (int round = 0; round < 4; ++round) {
      const char* rule = rules[trial.random() % rules.size()];
      CAPTURE(rule);
      const DartId a = trial.random_dart(), renamed_a{new_id[types::index(a)]};
      const RewriteOutcome here = trial.apply(rule, {a});
      const RewriteOutcome there = rewriter.apply(trial.rules.rule(rule), {&renamed_a, 1});
      REQUIRE(here.status == there.status);
      while (new_id.size() < map.dart_end()) new_id.push_back(static_cast<std::uint32_t>(new_id.size()));
      CHECK(here.effects.written_values == there.effects.written_values);
    }
    for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
      const DartId x{d}, y{new_id[d]};
      for (int i = 0; i <= map.dimension(); ++i) {
        CHECK(types::index(other->map.alpha(i, y)) == new_id[types::index(map.alpha(i, x))]);
      }
      for (types::EmbeddingId id : other->store.embeddings()) {
        const auto a = trial.state->store.get(id, x), b = other->store.get(id, y);
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
          CHECK(a[k] == doctest::Approx(b[k]).epsilon(1e-12));
        }
      }
    }
  });
}
