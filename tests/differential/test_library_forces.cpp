// SPDX-License-Identifier: MIT
// Every interaction of the standard library: what its graph computes against the tree evaluator,
// differences of its energy, and the laws of mechanics.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/ir_evaluate.h"
#include "engine/tree_eval.h"
#include "gmap/mesh_builders.h"
#include "library_world.h"

using namespace gmsim;
using compile::MatchRoles;
using compile::Shape;
using tests::LibraryWorld;
using types::DartId;

namespace {

using Long = long double;
using Vector = std::array<Long, 3>;

bool has_grad(const types::Expr& expr) {
  if (expr.kind == types::ExprKind::Grad) return true;
  for (const auto& argument : expr.args)
    if (argument && has_grad(*argument)) return true;
  return false;
}

/// The tree evaluator with parameters and lets in the frame; lets with derivatives are left out.
class Tree {
 public:
  Tree(LibraryWorld& world, const compile::InteractionBody& body, DartId hook,
       engine::Frame& frame)
      : evaluator_(world.state()), frame_(frame) {
    for (const auto& parameter : body.parameters)
      frame.set(parameter.slot, world.value(body.name + "." + parameter.name, hook));
    for (const auto& step : body.steps) {
      if (!known(*step.value)) {
        unknown_.insert(step.slot);
      } else {
        REQUIRE(evaluator_.assign(*step.value, step.slot, frame));
      }
    }
  }
  [[nodiscard]] bool known(const types::Expr& expr) const {
    if (has_grad(expr)) return false;
    if (expr.kind == types::ExprKind::Local && unknown_.contains(expr.slot)) return false;
    for (const auto& argument : expr.args)
      if (argument && !known(*argument)) return false;
    return true;
  }
  std::vector<double> value(const types::Expr& expr) {
    const auto result = evaluator_.evaluate(expr, frame_);
    REQUIRE(result.has_value());
    return result->data;
  }

 private:
  engine::TreeEvaluator evaluator_;
  engine::Frame& frame_;
  std::set<types::Slot> unknown_;
};

template <typename Number>
std::vector<Number> entries(const engine::IrEvaluator<Number>& evaluator, const Shape& shape,
                            compile::ir::NodeId id) {
  const std::uint32_t count = types::component_count({shape.graph[id].type});
  return {evaluator[id].begin(), evaluator[id].begin() + count};
}

/// The energy of a match as a function of positions, in long double.
class EnergyOf {
 public:
  EnergyOf(const Shape& shape, const MatchRoles& roles, LibraryWorld& world)
      : shape_(shape), evaluator_(shape.graph) {
    engine::gather_inputs(shape, roles.roles, world.state(), evaluator_);
    const auto position = world.world().position;
    for (std::uint32_t k = 0; k < shape.graph.inputs().size(); ++k) {
      const auto& input = shape.graph.inputs()[k];
      if (input.source == compile::ir::Input::Source::Embedding && input.embedding == position)
        position_inputs_[input.role] = k;
    }
    for (const auto& [role, input] : position_inputs_) {
      const auto at = world.value("position", roles.roles[role].dart);
      positions_[role] = {at[0], at[1], at[2]};
    }
  }
  /// - d energy / d position of a role, by a fourth-order central difference.
  Vector force(std::uint32_t role) {
    Vector result{};
    if (!position_inputs_.contains(role)) return result;
    constexpr Long h = 1e-4L;
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](Long shift) {
        Vector moved = positions_[role];
        moved[k] += shift;
        evaluator_.set_input(position_inputs_[role], moved);
        evaluator_.run();
        evaluator_.set_input(position_inputs_[role], positions_[role]);
        return evaluator_.number(shape_.energy);
      };
      result[k] = -(8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    }
    return result;
  }

 private:
  const Shape& shape_;
  engine::IrEvaluator<Long> evaluator_;
  std::map<std::uint32_t, std::uint32_t> position_inputs_;
  std::map<std::uint32_t, Vector> positions_;
};

struct Tally {
  std::size_t matches = 0;
  std::size_t tree_values = 0;
};

void check_tree_values(LibraryWorld& world, const compile::InteractionBody& body,
                       const std::vector<DartId>& nodes, engine::Frame& frame, Tally& tally) {
  Tree tree(world, body, nodes[body.hook], frame);
  compile::Wanted wanted;
  if (body.energy && tree.known(*body.energy)) wanted.values.push_back(body.energy);
  for (const auto& line : body.forces)
    if (line.value && !line.collection && tree.known(*line.value)) wanted.values.push_back(line.value);
  for (const auto& result : body.results)
    if (tree.known(*result.value)) wanted.values.push_back(result.value);
  compile::Specialiser specialiser(world.world(), body, wanted, world.value_sources());
  MatchRoles roles;
  Shape shape;
  REQUIRE_MESSAGE(specialiser.build(nodes, roles, shape), specialiser.failure().diagnostic.message);
  engine::IrEvaluator<double> evaluator(shape.graph);
  engine::gather_inputs(shape, roles.roles, world.state(), evaluator);
  evaluator.run();
  for (std::size_t i = 0; i < wanted.values.size(); ++i) {
    const auto expected = tree.value(*wanted.values[i]);
    const auto got = entries(evaluator, shape, shape.values[i].at(0));
    REQUIRE(expected == got);
    ++tally.tree_values;
  }
}

/// Explicit parts by role, summed in long double.
std::map<std::uint32_t, Vector> explicit_forces(LibraryWorld& world,
                                                const compile::InteractionBody& body,
                                                const std::vector<DartId>& nodes,
                                                const Shape& forces, const MatchRoles& roles) {
  compile::InteractionBody only_explicit = body;
  only_explicit.energy = nullptr;
  compile::Specialiser specialiser(world.world(), only_explicit,
                                   compile::wanted_forces(only_explicit, false),
                                   world.value_sources());
  MatchRoles own_roles;
  Shape shape;
  REQUIRE(specialiser.build(nodes, own_roles, shape));
  engine::IrEvaluator<Long> evaluator(shape.graph);
  engine::gather_inputs(shape, own_roles.roles, world.state(), evaluator);
  evaluator.run();
  std::map<std::uint32_t, Vector> result;
  for (const auto& root : shape.forces) {
    const compile::Role& vertex = own_roles.roles[root.role];
    for (const auto& other : forces.forces) {
      if (roles.roles[other.role].row != vertex.row) continue;
      for (int k = 0; k < 3; ++k) result[other.role][k] += evaluator[root.total][k];
    }
  }
  return result;
}

void check_forces(LibraryWorld& world, const compile::InteractionBody& body,
                  const std::vector<DartId>& nodes, const Shape& shape, const MatchRoles& roles) {
  engine::IrEvaluator<double> evaluator(shape.graph);
  engine::gather_inputs(shape, roles.roles, world.state(), evaluator);
  evaluator.run();
  std::optional<EnergyOf> energy;
  if (body.energy) energy.emplace(shape, roles, world);
  auto expected = explicit_forces(world, body, nodes, shape, roles);
  Vector sum{}, torque{};
  Long largest = 1e-3L;
  for (const auto& root : shape.forces) {
    Vector want = expected[root.role];
    if (energy) {
      const Vector conservative = energy->force(root.role);
      for (int k = 0; k < 3; ++k) want[k] += conservative[k];
    }
    const auto got = entries(evaluator, shape, root.total);
    const auto x = world.value("position", roles.roles[root.role].dart);
    for (int k = 0; k < 3; ++k) {
      CAPTURE(root.role);
      CHECK(std::abs(got[k] - want[k]) <= 1e-9L * std::max(Long(1), std::abs(want[k])));
      sum[k] += got[k];
      torque[k] += x[(k + 1) % 3] * got[(k + 2) % 3] - x[(k + 2) % 3] * got[(k + 1) % 3];
      largest = std::max<Long>(largest, std::abs(got[k]));
    }
  }
  if (body.external) return;
  for (int k = 0; k < 3; ++k) {
    CHECK(std::abs(sum[k]) <= 1e-13L * largest);
    CHECK(std::abs(torque[k]) <= 1e-13L * largest * 3);
  }
}

void check_interaction(LibraryWorld& world, std::uint32_t number, Tally& tally) {
  const compile::InteractionBody& body = world.program().interaction_bodies[number];
  CAPTURE(body.name);
  const compile::Wanted wanted = compile::wanted_forces(body, true);
  compile::ShapeSet shapes(world.world(), body, wanted, world.value_sources());
  compile::Specialiser specialiser(world.world(), body, wanted, world.value_sources());
  world.each_match(number, [&](const std::vector<DartId>& nodes, engine::Frame& frame) {
    MatchRoles roles, traced;
    const auto shape = shapes.classify(nodes, roles);
    REQUIRE_MESSAGE(shape, shapes.failure().diagnostic.message);
    REQUIRE(specialiser.trace(nodes, traced));
    REQUIRE(traced.key == shapes[*shape].key);
    REQUIRE(traced.targets == roles.targets);
    REQUIRE(traced.roles.size() == roles.roles.size());
    for (std::size_t i = 0; i < roles.roles.size(); ++i)
      REQUIRE(traced.roles[i].row == roles.roles[i].row);
    check_tree_values(world, body, nodes, frame, tally);
    check_forces(world, body, nodes, shapes[*shape], roles);
    ++tally.matches;
  });
}

void check_world(const gmap::Mesh& mesh, std::uint32_t seed, Tally& tally) {
  CAPTURE(seed);
  LibraryWorld world(mesh, seed);
  for (std::uint32_t i = 0; i < world.program().interactions.size(); ++i)
    check_interaction(world, i, tally);
}

}  // namespace

TEST_CASE("forces of every library interaction are those of its energy, and sum to zero") {
  Tally tally;
  check_world(gmap::grid(2, 2, 2, 2, gmap::GridCells::Mix2), 1, tally);
  check_world(gmap::grid(2, 1, 2, 1, gmap::GridCells::Tri4), 2, tally);
  check_world(gmap::box({2, 1, 1}, {2, 1, 1}, gmap::BoxElements::Hexes), 3, tally);
  check_world(gmap::box({1, 1, 1}, {1, 1, 1}, gmap::BoxElements::Tets5), 4, tally);
  check_world(gmap::chain(3, 3), 5, tally);
  CHECK(tally.matches > 500);
  CHECK(tally.tree_values > 500);
}

// ---- the formulas of the literature -------------------------------------------------------------

namespace {

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector scaled(Long s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Long dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Long norm(const Vector& a) { return std::sqrt(dot(a, a)); }

/// One interaction at work on a world: named nodes, parameters, forces by vertex.
class AtMatch {
 public:
  AtMatch(LibraryWorld& world, std::uint32_t number, std::vector<DartId> nodes)
      : world_(world), item_(world.program().interactions[number]), nodes_(std::move(nodes)) {
    const auto& body = world.program().interaction_bodies[number];
    compile::Specialiser specialiser(world.world(), body, compile::wanted_forces(body, false),
                                     world.value_sources());
    REQUIRE(specialiser.build(nodes_, roles_, shape_));
    evaluator_.emplace(shape_.graph);
    engine::gather_inputs(shape_, roles_.roles, world.state(), *evaluator_);
    evaluator_->run();
  }
  [[nodiscard]] Vector position(const std::string& node) const { return read("position", dart(node)); }
  [[nodiscard]] Vector velocity(const std::string& node) const { return read("velocity", dart(node)); }
  [[nodiscard]] Long parameter(const std::string& name) const {
    return world_.value(item_.name + "." + name, nodes_[item_.match.hooks[0]])[0];
  }
  [[nodiscard]] Vector force(const std::string& node) const {
    const auto& index = world_.state().store.index_of(world_.world().position);
    for (const auto& root : shape_.forces) {
      if (roles_.roles[root.role].row != index.row(dart(node))) continue;
      const auto& f = (*evaluator_)[root.total];
      return {f[0], f[1], f[2]};
    }
    FAIL("no force on ", node);
    return {};
  }
  void check(const std::string& node, const Vector& expected) const {
    const Vector got = force(node);
    CAPTURE(node);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(got[k] - expected[k]) <= 1e-12L * std::max(Long(1), norm(expected)));
  }

 private:
  [[nodiscard]] DartId dart(const std::string& node) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (item_.match.nodes[i].name == node) return nodes_[i];
    FAIL("no node ", node);
    return {};
  }
  [[nodiscard]] Vector read(const std::string& name, DartId d) const {
    const auto value = world_.value(name, d);
    return {value[0], value[1], value[2]};
  }

  LibraryWorld& world_;
  const compile::RootedPattern& item_;
  std::vector<DartId> nodes_;
  MatchRoles roles_;
  Shape shape_;
  std::optional<engine::IrEvaluator<double>> evaluator_;
};

template <typename Check>
void at_each_match(LibraryWorld& world, const std::string& name, const Check& check) {
  const std::uint32_t number = world.interaction(name);
  std::size_t matches = 0;
  world.each_match(number, [&](const std::vector<DartId>& nodes, engine::Frame&) {
    check(AtMatch(world, number, nodes));
    ++matches;
  });
  CHECK(matches > 0);
}

}  // namespace

TEST_CASE("stretch and linear bending springs: k (L - L0) plus damping along the spring") {
  LibraryWorld world(gmap::grid(2, 2, 2, 2, gmap::GridCells::Triangles), 7);
  const auto spring = [](const AtMatch& at, const std::string& i, const std::string& j,
                         Long fraction) {
    const Vector d = minus(at.position(j), at.position(i));
    const Vector u = scaled(1 / norm(d), d);
    const Long rate = dot(minus(at.velocity(j), at.velocity(i)), u);
    const Long pull = at.parameter("stiffness") / fraction * (norm(d) - at.parameter("rest")) +
                      at.parameter("damping") / fraction * rate;
    at.check(i, scaled(pull, u));
    at.check(j, scaled(-pull, u));
  };
  at_each_match(world, "stretch_spring",
                [&](const AtMatch& at) { spring(at, "a", "b", at.parameter("fraction")); });
  at_each_match(world, "linear_bending_spring", [&](const AtMatch& at) { spring(at, "p", "q", 1); });
}

TEST_CASE("hinges on triangles have the gradient of the discrete shells") {
  LibraryWorld world(gmap::grid(2, 2, 2, 2, gmap::GridCells::Triangles), 8);
  for (auto& decl : {"angular_bending_spring.damping"}) {
    const auto id = world.embedding(decl);
    world.value_sources().embeddings[types::index(id)] = compile::ValueSource::uniform({0.0});
  }
  at_each_match(world, "angular_bending_spring", [&](const AtMatch& at) {
    const Vector x0 = at.position("a"), x1 = at.position("b"), x2 = at.position("p"),
                 x3 = at.position("q");
    const Vector e = minus(x1, x0);
    const Long length = norm(e);
    const Vector n1 = cross(e, minus(x2, x0)), n2 = cross(minus(x3, x0), e);
    const Long theta = std::atan2(dot(cross(n1, n2), e) / length, dot(n1, n2));
    const Vector a = scaled(1 / dot(n1, n1), n1), b = scaled(1 / dot(n2, n2), n2);
    const Long moment = -at.parameter("stiffness") * at.parameter("fraction") *
                        std::remainder(theta - at.parameter("rest"), 2 * std::acos(Long(-1)));
    at.check("p", scaled(-length * moment, a));
    at.check("q", scaled(-length * moment, b));
    at.check("a", scaled(-moment / length, plus(scaled(dot(minus(x2, x1), e), a),
                                                scaled(dot(minus(x3, x1), e), b))));
    at.check("b", scaled(moment / length, plus(scaled(dot(minus(x2, x0), e), a),
                                               scaled(dot(minus(x3, x0), e), b))));
  });
}

TEST_CASE("corner springs turn their arms") {
  LibraryWorld world(gmap::grid(2, 1, 2, 1, gmap::GridCells::Mix2), 9);
  at_each_match(world, "angular_shear_spring", [&](const AtMatch& at) {
    const Vector u = minus(at.position("b"), at.position("a"));
    const Vector v = minus(at.position("d"), at.position("a"));
    const Vector across = cross(u, v);
    const Vector n = scaled(1 / norm(across), across);
    const Long phi = std::atan2(norm(across), dot(u, v));
    const Vector to_b = scaled(-1 / dot(u, u), cross(n, u));
    const Vector to_d = scaled(1 / dot(v, v), cross(n, v));
    const Long rate = dot(to_b, minus(at.velocity("b"), at.velocity("a"))) +
                      dot(to_d, minus(at.velocity("d"), at.velocity("a")));
    const Long moment = -(at.parameter("stiffness") * (phi - at.parameter("rest")) +
                          at.parameter("damping") * rate) /
                        at.parameter("fraction");
    at.check("b", scaled(moment, to_b));
    at.check("d", scaled(moment, to_d));
    at.check("a", scaled(-moment, plus(to_b, to_d)));
  });
}
