// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "compile/specialise.h"
#include "differential/library_world.h"
#include "gmap/mesh_builders.h"

using namespace gmsim;
using compile::MatchRoles;
using compile::Shape;
using compile::ValueSource;
using support::DiagnosticKind;
using tests::LibraryWorld;
using types::DartId;
namespace ir = compile::ir;

namespace {

gmap::Mesh small_grid() { return gmap::grid(2, 2, 2, 2, gmap::GridCells::Mix2); }

/// Operations and inputs that the roots need; constants are part of them.
std::pair<std::size_t, std::size_t> cost(const Shape& shape) {
  const std::vector<bool> used = ir::reachable(shape.graph, shape.roots());
  std::size_t operations = 0, inputs = 0;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const ir::Op op = shape.graph[ir::NodeId{i}].op;
    inputs += op == ir::Op::Input;
    operations += op != ir::Op::Input && op != ir::Op::Constant;
  }
  return {operations, inputs};
}

void make_uniform(LibraryWorld& world, const std::string& name, double value) {
  world.value_sources().embeddings[types::index(world.embedding(name))] =
      ValueSource::uniform({value});
}

/// Shapes of an interaction over all its matches.
std::vector<std::size_t> matches_by_shape(LibraryWorld& world, const std::string& name,
                                          compile::ShapeSet& shapes) {
  std::vector<std::size_t> counts;
  world.each_match(world.interaction(name), [&](const std::vector<DartId>& nodes, engine::Frame&) {
    MatchRoles roles;
    const auto shape = shapes.classify(nodes, roles);
    REQUIRE_MESSAGE(shape, shapes.failure().diagnostic.message);
    counts.resize(shapes.size());
    ++counts[*shape];
  });
  return counts;
}

const compile::InteractionBody& body_of(const LibraryWorld& world, const std::string& name) {
  return world.program().interaction_bodies[world.interaction(name)];
}

/// The failure of specialising a law for the first match it has.
compile::SpecialiseFailure failure_of(const std::string& rules, const std::string& name,
                                      const gmap::Mesh& mesh) {
  LibraryWorld world(mesh, 1, rules);
  const auto& body = body_of(world, name);
  compile::Specialiser specialiser(world.world(), body, compile::wanted_forces(body, false),
                                   world.value_sources());
  std::optional<compile::SpecialiseFailure> failure;
  world.each_match(world.interaction(name), [&](const std::vector<DartId>& nodes, engine::Frame&) {
    MatchRoles roles;
    Shape shape;
    if (!failure && !specialiser.build(nodes, roles, shape)) failure = specialiser.failure();
  });
  REQUIRE(failure.has_value());
  return *failure;
}

}  // namespace

TEST_CASE("a stretch spring with damping costs few operations and shares its force") {
  LibraryWorld world(small_grid(), 1);
  for (const auto& [name, value] : {std::pair{"stiffness", 60.0}, {"damping", 0.1}, {"fraction", 1.0}})
    make_uniform(world, std::string("stretch_spring.") + name, value);
  const auto& body = body_of(world, "stretch_spring");
  compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, false),
                           world.value_sources());
  CHECK(matches_by_shape(world, "stretch_spring", shapes).size() == 1);
  const Shape& shape = shapes[0];
  INFO(ir::to_string(shape.graph, shape.roots()));
  const auto [operations, inputs] = cost(shape);
  CHECK(operations <= 12);
  CHECK(inputs == 5);
  REQUIRE(shape.forces.size() == 2);
  ir::Graph graph = shape.graph;
  CHECK(graph.make(ir::Op::Neg, shape.forces[0].total) == shape.forces[1].total);
}

TEST_CASE("what is zero everywhere is not computed") {
  LibraryWorld world(small_grid(), 1);
  make_uniform(world, "stretch_spring.damping", 0.0);
  const auto& body = body_of(world, "stretch_spring");
  compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, false),
                           world.value_sources());
  (void)matches_by_shape(world, "stretch_spring", shapes);
  for (const std::uint32_t input : shapes[0].live_inputs())
    CHECK(shapes[0].graph.inputs()[input].embedding != world.embedding("velocity"));
}

TEST_CASE("a law on cells of any arity has a shape for each arity") {
  const std::string rules = R"(
    interaction keep_area on face(a) {
      dimension 2;
      param stiffness : real [N/m^3] = 2;
      param size : real [m^2] = 1;
      energy 0.5 * stiffness * (norm(area_vector(a)) - size)^2;
      force x in polygon(a) on corner;
    })";
  LibraryWorld world(small_grid(), 2, rules);
  const auto& body = body_of(world, "keep_area");
  compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, false),
                           world.value_sources());
  auto counts = matches_by_shape(world, "keep_area", shapes);
  std::sort(counts.begin(), counts.end());
  CHECK(counts == std::vector<std::size_t>{2, 4});
  for (std::size_t i = 0; i < shapes.size(); ++i)
    CHECK(shapes[i].forces.size() == shapes[i].targets.size());
}

TEST_CASE("a vertex reached twice is one role and one force") {
  gmap::Mesh pillow;
  pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.add_cell(gmap::Mesh::CellKind::Polygon, {0, 1, 2});
  pillow.add_cell(gmap::Mesh::CellKind::Polygon, {2, 1, 0});
  LibraryWorld world(pillow, 3);
  const auto& body = body_of(world, "linear_bending_spring");
  compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, false),
                           world.value_sources());
  (void)matches_by_shape(world, "linear_bending_spring", shapes);
  REQUIRE(shapes.size() == 1);
  CHECK(shapes[0].forces.size() == 1);  // both neighbours are the third corner
  CHECK(shapes[0].targets.size() == 2);
  CHECK(shapes[0].graph.is_zero(shapes[0].forces[0].total));
}

TEST_CASE("a dart that numbers choose is refused with its place") {
  const auto failure = failure_of(R"(
    interaction odd on face(a) {
      dimension 2;
      param drag : real [N s/m] = 1;
      let top = argmax(x in polygon(a) : x.position.z : x);
      force x in polygon(a) on corner = drag * top.velocity;
    })", "odd", small_grid());
  CHECK_FALSE(failure.not_here);
  CHECK(failure.diagnostic.kind == DiagnosticKind::NotConstant);
  CHECK(failure.diagnostic.place.has_value());
  CHECK(failure.diagnostic.notes.back().find("in `odd` at the match a = ") == 0);
}

TEST_CASE("an open face names its dart") {
  gmap::Mesh mesh = gmap::grid(1, 1, 1, 1, gmap::GridCells::Quads);
  LibraryWorld world(mesh, 1);
  world.state().map.unlink(1, DartId{0});
  const auto& body = body_of(world, "wind");
  compile::Specialiser specialiser(world.world(), body, compile::wanted_forces(body, false),
                                   world.value_sources());
  MatchRoles roles;
  CHECK_FALSE(specialiser.trace(std::array{DartId{0}}, roles));
  CHECK(specialiser.failure().diagnostic.kind == DiagnosticKind::OpenFace);
  CHECK(specialiser.failure().diagnostic.message.find("dart 0") != std::string::npos);
}

TEST_CASE("an optional value that is missing means: not here") {
  LibraryWorld world(small_grid(), 1, R"(
    embedding strength : real [N s/m] on vertex optional;
    interaction held on vertex(a) { force a on vertex = a.strength * a.velocity; })");
  auto& column = world.state().store.use(world.embedding("strength"));
  column.clear(2);
  const auto& body = body_of(world, "held");
  compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, false),
                           world.value_sources());
  std::size_t here = 0, missing = 0;
  world.each_match(world.interaction("held"), [&](const std::vector<DartId>& nodes, engine::Frame&) {
    MatchRoles roles;
    if (shapes.classify(nodes, roles)) {
      ++here;
    } else {
      ++missing;
      CHECK(shapes.failure().not_here);
    }
  });
  CHECK(here == 8);
  CHECK(missing == 1);
}

TEST_CASE("a uniform parameter exists only where its interaction does") {
  LibraryWorld world(small_grid(), 1);
  make_uniform(world, "stretch_spring.rest", 1.0);
  auto& marks = world.state().store.use(world.embedding("stretch_spring"));
  const auto criterion = std::find_if(
      world.program().criterion_bodies.begin(), world.program().criterion_bodies.end(),
      [](const auto& body) { return body.name == "spring_elongation"; });
  REQUIRE(criterion != world.program().criterion_bodies.end());
  compile::ValueSources sources = world.value_sources();
  sources.parameters.push_back({criterion->parameters[0].slot, ValueSource::uniform({0.5})});
  compile::ShapeSet shapes(world.world(), *criterion, compile::wanted_values(*criterion), sources);
  const auto classify = [&](DartId a) {
    MatchRoles roles;
    return shapes.classify(std::array{a, world.state().map.alpha(0, a)}, roles).has_value();
  };
  CHECK(classify(DartId{4}));
  marks.clear(world.state().store.index_of(world.embedding("stretch_spring")).row(DartId{0}));
  CHECK_FALSE(classify(DartId{0}));
  CHECK(shapes.failure().not_here);
}

TEST_CASE("derived values move with what they read") {
  LibraryWorld world(small_grid(), 1, R"(
    derived area : real on face(a) = norm(area_vector(a));
    derived share : real on corner(a) = a.area / 4;
    derived weight : real on vertex(a) = 2 * a.mass;)");
  const auto moving = compile::values_in_motion(
      world.program().schema, {world.embedding("position"), world.embedding("velocity")});
  CHECK(moving[types::index(world.embedding("area"))]);
  CHECK(moving[types::index(world.embedding("share"))]);
  CHECK_FALSE(moving[types::index(world.embedding("mass"))]);
  CHECK_FALSE(moving[types::index(world.embedding("weight"))]);
}
