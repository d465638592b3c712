// SPDX-License-Identifier: MIT
// The forces of whole models: single matches summed up, the laws of mechanics, derivatives, bounds.
#include <doctest/doctest.h>

#include <cstring>

#include "engine/atomic_forces.h"
#include "engine/ir_evaluate.h"
#include "force_world.h"
#include "gmap/mesh_builders.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

std::vector<std::pair<std::string, gmap::Mesh>> meshes() {
  return {{"mix2", gmap::grid(3, 2, 3, 2, gmap::GridCells::Mix2)},
          {"tri4", gmap::grid(2, 2, 2, 2, gmap::GridCells::Tri4)},
          {"hexes", gmap::box({2, 2, 1}, {2, 2, 1}, gmap::BoxElements::Hexes)},
          {"tets", gmap::box({1, 1, 1}, {1, 1, 1}, gmap::BoxElements::Tets5)},
          {"chain", gmap::chain(4, 4)}};
}

bool is_internal(const compile::InteractionBody& body) { return !body.external; }
bool any(const compile::InteractionBody&) { return true; }

std::unique_ptr<engine::ForceField> tree_forces(ForceWorld& world, const engine::Model& model) {
  support::Diagnostics diagnostics;
  auto forces = engine::make_tree_forces(world.state(), model, diagnostics);
  REQUIRE_MESSAGE(forces, diagnostics.all().front().message);
  return forces;
}

std::unique_ptr<engine::ForceField> kernel_forces(ForceWorld& world, const engine::Model& model,
                                                  unsigned threads,
                                                  engine::ForceOptions options) {
  support::Diagnostics diagnostics;
  auto forces =
      engine::make_kernel_forces(world.state(), model, threads, diagnostics, options);
  REQUIRE_MESSAGE(forces, diagnostics.all().front().message);
  return forces;
}

std::unique_ptr<engine::ForceField> kernel_forces(ForceWorld& world, const engine::Model& model,
                                                  unsigned threads = 1, bool merge = false) {
  return kernel_forces(world, model, threads, engine::ForceOptions{.merge = merge});
}

Records evaluate(engine::ForceField& forces, const engine::Motion& motion, double time = 0) {
  Records force(motion.position.size());
  REQUIRE_MESSAGE(forces.evaluate(motion, time, 1e-3, force), forces.error()->message);
  return force;
}

template <typename Check>
void on_all_meshes(const Check& check) {
  std::uint32_t seed = 0;
  for (const auto& [name, mesh] : meshes()) {
    CAPTURE(name);
    ForceWorld world(mesh, ++seed);
    world.free_all();
    check(world, seed);
  }
}

/// Forces from the store alone, interaction by interaction and match by match.
Records forces_one_by_one(ForceWorld& world, const engine::Model& model) {
  Records force(world.vertices().row_end());
  for (const auto& active : model.interactions) {
    const auto& body = world.program().interaction_bodies[active.interaction];
    compile::Specialiser specialiser(world.world(), body, compile::wanted_forces(body, false),
                                     world.value_sources());
    world.each_match(active.interaction, [&](const std::vector<types::DartId>& nodes, auto&) {
      compile::MatchRoles roles;
      compile::Shape shape;
      REQUIRE(specialiser.build(nodes, roles, shape));
      engine::IrEvaluator<double> evaluator(shape.graph);
      engine::gather_inputs(shape, roles.roles, world.state(), evaluator);
      evaluator.run();
      for (const auto& root : shape.forces) {
        auto& sum = force[roles.roles[root.role].row];
        const auto& value = evaluator[root.total];
        sum = {sum.x + value[0], sum.y + value[1], sum.z + value[2], 0};
      }
    });
  }
  return force;
}

}  // namespace

TEST_CASE("any number of threads gives the same bits, merged or not") {
  // Enough matches for several pieces and chunks.
  for (const gmap::Mesh& mesh : {gmap::grid(40, 40, 1, 1, gmap::GridCells::Mix4),
                                 gmap::box({12, 12, 6}, {1, 1, 1}, gmap::BoxElements::Hexes)}) {
    ForceWorld world(mesh, 5);
    const engine::Model model = model_of(world.program(), false, any);
    for (const bool merge : {false, true}) {
      CAPTURE(merge);
      const engine::Motion motion = world.motion();
      const Records alone = evaluate(*kernel_forces(world, model, 1, merge), motion);
      for (const unsigned threads : {2u, 3u, 5u}) {
        CAPTURE(threads);
        const auto forces = kernel_forces(world, model, threads, merge);
        // The first evaluations are shared and done alone in turn.
        for (int k = 0; k < 4; ++k) {
          const Records shared = evaluate(*forces, motion);
          REQUIRE(std::memcmp(alone.data(), shared.data(), alone.size() * sizeof(VertexRecord)) == 0);
        }
      }
    }
  }
}

TEST_CASE("the oracle adds up what single matches compute") {
  on_all_meshes([](ForceWorld& world, std::uint32_t) {
    const engine::Model model = model_of(world.program(), false, any);
    const auto forces = tree_forces(world, model);
    const Records got = evaluate(*forces, world.motion());
    const Records expected = forces_one_by_one(world, model);
    for (std::size_t row = 0; row < got.size(); ++row) {
      // Derived values come as columns here and as expressions there.
      CHECK(got[row].x == doctest::Approx(expected[row].x).epsilon(1e-13));
      CHECK(got[row].y == doctest::Approx(expected[row].y).epsilon(1e-13));
      CHECK(got[row].z == doctest::Approx(expected[row].z).epsilon(1e-13));
    }
    CHECK(largest(got) > 0.1);
  });
}

TEST_CASE("internal forces of a free body sum to no force and no torque") {
  on_all_meshes([](ForceWorld& world, std::uint32_t) {
    const auto forces = tree_forces(world, model_of(world.program(), false, is_internal));
    const engine::Motion motion = world.motion();
    const Records force = evaluate(*forces, motion);
    std::array<double, 3> sum{}, torque{};
    for (std::size_t row = 0; row < force.size(); ++row) {
      const VertexRecord& x = motion.position[row];
      const VertexRecord& f = force[row];
      sum = {sum[0] + f.x, sum[1] + f.y, sum[2] + f.z};
      torque = {torque[0] + x.y * f.z - x.z * f.y, torque[1] + x.z * f.x - x.x * f.z,
                torque[2] + x.x * f.y - x.y * f.x};
    }
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(sum[k]) <= 1e-13 * largest(force) * 3);
      CHECK(std::abs(torque[k]) <= 1e-13 * largest(force) * 10);
    }
  });
}

TEST_CASE("the product is the derivative of the forces") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    const auto forces = tree_forces(world, model_of(world.program(), false, is_internal));
    const engine::Motion motion = world.motion();
    const Records dx = random_records(motion.position.size(), seed);
    const Records dv = random_records(motion.position.size(), seed + 100);
    Records product(motion.position.size());
    REQUIRE(forces->product(motion, 0, dx, dv, product));
    constexpr double h = 1e-5;
    const auto at = [&](double s) {
      return evaluate(*forces, {plus(motion.position, scaled(s, dx)),
                                plus(motion.velocity, scaled(s, dv))});
    };
    const Records difference =
        scaled(1 / (12 * h), plus(scaled(8, plus(at(h), scaled(-1, at(-h)))),
                                  scaled(-1, plus(at(2 * h), scaled(-1, at(-2 * h))))));
    CHECK(largest(plus(product, scaled(-1, difference))) <= 1e-7 * largest(product));
    CHECK(largest(product) > 0.1);
  });
}

TEST_CASE("energies are the potential of the forces without velocities") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    const auto forces = tree_forces(world, model_of(world.program(), false, is_internal));
    engine::Motion motion = world.motion();
    motion.velocity.assign(motion.velocity.size(), {});
    const Records dx = random_records(motion.position.size(), seed);
    const auto energy = [&](double s) {
      double value = 0;
      REQUIRE(forces->potential_energy({plus(motion.position, scaled(s, dx)), motion.velocity}, 0,
                                       value));
      return value;
    };
    constexpr double h = 1e-4;
    const double slope = (8 * (energy(h) - energy(-h)) - energy(2 * h) + energy(-2 * h)) / (12 * h);
    CHECK(dot(evaluate(*forces, motion), dx) == doctest::Approx(-slope).epsilon(1e-7));
  });
}

namespace {

/// Largest eigenvalue of M^-1/2 K M^-1/2 by power iteration with a shift that keeps it the largest
/// in modulus: a lower bound.
double global_eigenvalue(const std::function<Records(const Records&)>& times_k,
                         const std::vector<double>& mass, std::uint32_t seed) {
  Records x = random_records(mass.size(), seed);
  const auto weighted = [&](Records a) {
    for (std::size_t row = 0; row < a.size(); ++row) {
      const double w = mass[row] > 0 ? 1 / std::sqrt(mass[row]) : 0;
      a[row] = {w * a[row].x, w * a[row].y, w * a[row].z, 0};
    }
    return a;
  };
  double value = 0, shift = 0;
  for (int k = 0; k < 300; ++k) {
    x = scaled(1 / std::sqrt(dot(x, x)), x);
    const Records y = weighted(times_k(weighted(x)));
    value = dot(x, y);
    shift = std::max(shift, std::sqrt(dot(y, y)));
    x = plus(y, scaled(shift, x));
  }
  return value;
}

}  // namespace

TEST_CASE("the element bound is above the largest global eigenvalue") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    const auto forces = tree_forces(world, model_of(world.program(), false, is_internal));
    const engine::Motion motion = world.motion();
    engine::ForceField::ElementBound bound;
    REQUIRE(forces->element_bound(motion, 0, bound));
    const Records none(motion.position.size());
    Records out(motion.position.size());
    const auto stiffness = [&](const Records& x) {
      REQUIRE(forces->product(motion, 0, x, none, out));
      return scaled(-1, out);
    };
    const auto damping = [&](const Records& x) {
      REQUIRE(forces->product(motion, 0, none, x, out));
      return scaled(-1, out);
    };
    const double omega2 = global_eigenvalue(stiffness, world.masses(), seed);
    const double rate = global_eigenvalue(damping, world.masses(), seed);
    CHECK(omega2 > 0);
    CHECK(bound.stiffness >= omega2);
    CHECK(bound.damping >= rate);
    CHECK(bound.where != types::kNoDart);
  });
}

namespace {

/// Springs of the paper's cloth (Fig. 14), everywhere at rest on a lattice of spacing 1.
engine::Model cloth_model(const compile::Program& program) {
  const auto value = [](const std::string& spring, const std::string& parameter) {
    if (parameter == "stiffness")
      return spring == "stretch_spring" ? 60.0 : spring == "linear_shear_spring" ? 43.0 : 10.0;
    if (parameter.substr(0, 4) == "rest")
      return spring == "stretch_spring" ? 1.0 : spring == "linear_shear_spring" ? std::sqrt(2) : 2.0;
    return parameter == "damping" ? 0.1 : 1.0;
  };
  engine::Model model = model_of(program, true, [](const auto& body) {
    return body.name == "stretch_spring" || body.name == "linear_shear_spring" ||
           body.name == "linear_bending_spring";
  });
  for (auto& active : model.interactions) {
    const auto& body = program.interaction_bodies[active.interaction];
    for (std::size_t i = 0; i < active.parameters.size(); ++i)
      active.parameters[i].uniform.data = {value(body.name, body.parameters[i].name)};
  }
  return model;
}

void lay_flat(ForceWorld& world) {
  auto& column = world.state().store.column(world.embedding("position"));
  for (gmap::Row row = 0; row < column.row_end(); ++row) {
    const auto at = column.get(row);
    column.set(row, std::array{std::round(at[0]), std::round(at[1]), std::round(at[2])});
  }
  auto& mass = world.state().store.column(world.embedding("corner_mass"));
  for (gmap::Row row = 0; row < mass.row_end(); ++row) mass.set(row, std::array{0.1 / 400});
}

}  // namespace

TEST_CASE("the bound of the paper's cloth is close to its largest eigenvalue") {
  ForceWorld world(gmap::grid(10, 10, 10, 10, gmap::GridCells::Quads), 1);
  world.free_all();
  lay_flat(world);
  const auto forces = tree_forces(world, cloth_model(world.program()));
  const engine::Motion motion = world.motion();
  engine::ForceField::ElementBound bound;
  REQUIRE(forces->element_bound(motion, 0, bound));
  const Records none(motion.position.size());
  Records out(motion.position.size());
  const double omega2 = global_eigenvalue(
      [&](const Records& x) {
        REQUIRE(forces->product(motion, 0, x, none, out));
        return scaled(-1, out);
      },
      world.masses(), 1);
  CHECK(omega2 == doctest::Approx(663436.8461963221).epsilon(1e-3));
  CHECK(bound.stiffness >= 663436.8461963221);
  CHECK(bound.stiffness <= 1.6 * omega2);
}

TEST_CASE("a spring without length pulls nowhere and is named once") {
  ForceWorld world(gmap::chain(3, 3), 5);
  world.free_all();
  const auto forces = tree_forces(world, model_of(world.program(), false, [](const auto& body) {
                                    return body.name == "stretch_spring";
                                  }));
  engine::Motion motion = world.motion();
  CHECK(forces->notices(motion, 0).empty());
  motion.position[1] = motion.position[0];
  const auto notices = forces->notices(motion, 0);
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].severity == support::Severity::Warning);
  CHECK(notices[0].message.find("stretch_spring") != std::string::npos);
  CHECK(forces->notices(motion, 0).empty());
  motion.velocity.assign(motion.velocity.size(), {});
  const Records force = evaluate(*forces, motion);
  CHECK(force[0].x == 0);
}

TEST_CASE("a force that is not finite names its rule, match and place") {
  ForceWorld world(gmap::chain(3, 3), 6);
  const auto forces = tree_forces(world, model_of(world.program(), false, [](const auto& body) {
                                    return body.name == "stretch_spring";
                                  }));
  engine::Motion motion = world.motion();
  motion.position[2].y = std::nan("");
  Records force(motion.position.size());
  CHECK_FALSE(forces->evaluate(motion, 0, 1e-3, force));
  REQUIRE(forces->error());
  CHECK(forces->error()->kind == support::DiagnosticKind::NonFinite);
  CHECK(forces->error()->message.find("`stretch_spring`") != std::string::npos);
  CHECK(forces->error()->message.find("a = ") != std::string::npos);
  CHECK(forces->error()->place.has_value());
}

// ---- kernels ------------------------------------------------------------------------------------

namespace {

bool same_bits(const Records& a, const Records& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(VertexRecord)) == 0;
}

/// Forces, products and energies of two fields, bit by bit, at several motions.
void compare_bits(engine::ForceField& expected, engine::ForceField& got, ForceWorld& world,
                  std::uint32_t seed) {
  engine::Motion motion = world.motion();
  for (std::uint32_t k = 0; k < 3; ++k) {
    const double time = 0.3 * k;
    CHECK(same_bits(evaluate(expected, motion, time), evaluate(got, motion, time)));
    const Records dx = random_records(motion.position.size(), seed + k);
    const Records dv = random_records(motion.position.size(), seed + k + 50);
    Records product(dx.size()), other(dx.size());
    REQUIRE(expected.product(motion, time, dx, dv, product));
    REQUIRE(got.product(motion, time, dx, dv, other));
    CHECK(same_bits(product, other));
    double energy = 0, other_energy = 0;
    REQUIRE(expected.potential_energy(motion, time, energy));
    REQUIRE(got.potential_energy(motion, time, other_energy));
    CHECK(energy == other_energy);
    motion.position = plus(motion.position, scaled(0.05, dx));
    motion.velocity = plus(motion.velocity, scaled(0.5, dv));
  }
}

}  // namespace

TEST_CASE("kernels give the bits of the oracle, on any number of threads") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    for (const bool uniform : {false, true}) {
      const engine::Model model = model_of(world.program(), uniform, any);
      const auto tree = tree_forces(world, model);
      for (unsigned threads = 1; threads <= 4; ++threads) {
        CAPTURE(threads);
        const auto kernels = kernel_forces(world, model, threads);
        CHECK(kernels->reads_velocity() == tree->reads_velocity());
        CHECK(kernels->reads_time() == tree->reads_time());
        for (int turn = 0; turn < 4; ++turn)  // past the probe that chooses how to run
          compare_bits(*tree, *kernels, world, seed + static_cast<std::uint32_t>(turn));
      }
    }
  });
}

TEST_CASE("parameters of time are computed at every stage") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    engine::Model model = model_of(world.program(), false, any);
    types::Expr clock;
    clock.kind = types::ExprKind::Time;
    clock.type = {types::ValueKind::Real};
    for (auto& active : model.interactions) {
      const auto& body = world.program().interaction_bodies[active.interaction];
      for (std::size_t i = 0; i < active.parameters.size(); ++i) {
        if (body.parameters[i].name != "stiffness") continue;
        active.parameters[i].kind = engine::ParameterBinding::Kind::OfTime;
        active.parameters[i].expression.value = std::make_shared<types::Expr>(clock);
      }
    }
    const auto tree = tree_forces(world, model), kernels = kernel_forces(world, model);
    CHECK(tree->reads_time());
    CHECK(kernels->reads_time());
    compare_bits(*tree, *kernels, world, seed);
    CHECK_FALSE(same_bits(evaluate(*tree, world.motion(), 1), evaluate(*tree, world.motion(), 2)));
  });
}

TEST_CASE("kernels find the oracle's bounds") {
  on_all_meshes([](ForceWorld& world, std::uint32_t) {
    const engine::Model model = model_of(world.program(), false, any);
    engine::ForceField::ElementBound expected, got;
    REQUIRE(tree_forces(world, model)->element_bound(world.motion(), 0, expected));
    REQUIRE(kernel_forces(world, model)->element_bound(world.motion(), 0, got));
    CHECK(got.stiffness == doctest::Approx(expected.stiffness).epsilon(1e-12));  // another order
    CHECK(got.damping == doctest::Approx(expected.damping).epsilon(1e-12));
    CHECK(got.where == expected.where);
    CHECK(got.interaction == expected.interaction);
  });
}

TEST_CASE("kernels report what the oracle reports") {
  ForceWorld world(gmap::chain(3, 3), 6);
  const engine::Model model = model_of(
      world.program(), false, [](const auto& body) { return body.name == "stretch_spring"; });
  const auto tree = tree_forces(world, model);
  const auto kernels = kernel_forces(world, model, 2);
  engine::Motion motion = world.motion();
  motion.position[1] = motion.position[0];
  const auto expected = tree->notices(motion, 0), got = kernels->notices(motion, 0);
  REQUIRE(expected.size() == 1);
  REQUIRE(got.size() == 1);
  CHECK(got[0].message == expected[0].message);
  CHECK(kernels->notices(motion, 0).empty());
  motion.position[2].y = std::nan("");
  Records force(motion.position.size());
  CHECK_FALSE(tree->evaluate(motion, 0, 1e-3, force));
  CHECK_FALSE(kernels->evaluate(motion, 0, 1e-3, force));
  CHECK(kernels->error()->message == tree->error()->message);
  CHECK(kernels->error()->notes == tree->error()->notes);
}

// ---- merging ------------------------------------------------------------------------------------

TEST_CASE("merged matches give the forces of single ones but for rounding") {
  on_all_meshes([](ForceWorld& world, std::uint32_t seed) {
    for (const bool uniform : {false, true}) {
      const engine::Model model = model_of(world.program(), uniform, any);
      const auto single = kernel_forces(world, model), merged = kernel_forces(world, model, 2, true);
      const engine::Motion motion = world.motion();
      const Records expected = evaluate(*single, motion), got = evaluate(*merged, motion);
      CHECK(largest(plus(got, scaled(-1, expected))) <= 1e-14 * largest(expected));
      const Records dx = random_records(motion.position.size(), seed);
      Records product(dx.size()), other(dx.size());
      REQUIRE(single->product(motion, 0, dx, dx, product));
      REQUIRE(merged->product(motion, 0, dx, dx, other));
      CHECK(largest(plus(other, scaled(-1, product))) <= 1e-14 * largest(product));
    }
  });
}

namespace {

Records evaluate_end(engine::ForceField& forces, const engine::Motion& motion) {
  Records force(motion.position.size());
  REQUIRE_MESSAGE(forces.evaluate_end(motion, 0, 1e-3, force), forces.error()->message);
  return force;
}

/// The forces of single matches as criteria read them, in the canonical order.
Records kept_forces(const engine::ForceField& forces, std::vector<engine::AtomicForce>& list) {
  list.clear();
  forces.list_atomic(list);
  Records result;
  for (const engine::AtomicForce& force : list) {
    const VertexRecord& there = forces.atomic_slots()[force.slot];
    result.push_back({force.share * there.x, force.share * there.y, force.share * there.z, 0});
  }
  return result;
}

}  // namespace

TEST_CASE("sums of internal forces are those of a model without loads, bit by bit") {
  on_all_meshes([](ForceWorld& world, std::uint32_t) {
    const engine::Motion motion = world.motion();
    const auto internal = kernel_forces(world, model_of(world.program(), true, is_internal), 1, true);
    const Records expected = evaluate(*internal, motion);
    const auto all = kernel_forces(world, model_of(world.program(), true, any), 3,
                                   {.merge = true, .internal = true});
    const Records force = evaluate_end(*all, motion);
    const auto got = all->internal_sums();
    REQUIRE(got.size() == expected.size());
    CHECK(std::memcmp(got.data(), expected.data(), expected.size() * sizeof(VertexRecord)) == 0);
    CHECK(largest(plus(force, scaled(-1, expected))) > 0.1);
  });
}

TEST_CASE("forces of single matches are told apart where matches are merged") {
  on_all_meshes([](ForceWorld& world, std::uint32_t) {
    for (const bool uniform : {false, true}) {
      const engine::Model model = model_of(world.program(), uniform, any);
      const engine::Motion motion = world.motion();
      const auto single = kernel_forces(world, model, 1, {.merge = false, .atomic = true});
      const auto merged = kernel_forces(world, model, 1, {.merge = true, .internal = true, .atomic = true});
      const double largest_force = largest(evaluate_end(*single, motion));
      evaluate_end(*merged, motion);
      std::vector<engine::AtomicForce> expected_list, list;
      const Records expected = kept_forces(*single, expected_list), got = kept_forces(*merged, list);
      REQUIRE(got.size() == expected.size());
      CHECK(largest(plus(got, scaled(-1, expected))) <= 1e-14 * largest_force);
      Records sums(motion.position.size());
      for (std::size_t k = 0; k < list.size(); ++k) {
        CHECK(list[k].dart == expected_list[k].dart);
        VertexRecord& sum = sums[world.vertices().row(list[k].dart)];
        sum = {sum.x + got[k].x, sum.y + got[k].y, sum.z + got[k].z, 0};
      }
      const auto internal = merged->internal_sums();
      const Records totals(internal.begin(), internal.end());
      CHECK(largest(plus(sums, scaled(-1, totals))) <= 1e-13 * largest_force);
    }
  });
}

TEST_CASE("parallel springs of the cloth merge") {
  ForceWorld world(gmap::grid(10, 10, 10, 10, gmap::GridCells::Quads), 1);
  lay_flat(world);
  const auto forces = kernel_forces(world, cloth_model(world.program()), 1, true);
  const std::string plan = forces->explain();
  CAPTURE(plan);
  CHECK(plan.find("400 matches, merged to 220") != std::string::npos);
}
