// SPDX-License-Identifier: MIT
// The examples of the language, item by item: each must be accepted in the dimensions that it is for.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check_text.h"

namespace {

using gmsim::check_tests::check_text;

const std::string kData = R"(
/// What every mechanical model needs.
orbit corner = <1..n-1>;
embedding position    : vec3 [m]   on vertex merge mean;
embedding velocity    : vec3 [m/s] on vertex merge mean = (0, 0, 0);
embedding fixed       : bool       on vertex merge max = false;
embedding corner_mass : real [kg]  on corner extensive;
derived   mass        : real [kg]  on vertex(v) = sum(c in vertex(v) / corner : c.corner_mass);
embedding vertex_stress : sym3 [Pa] on vertex optional merge mean;
)";

const std::string kFunctions = R"(
function centroid(a)    = mean(x in element(a) / vertex : x.position);
function area_vector(a) = 0.5 * sum(x in polygon(a) : cross(x.position, x@0.position));
/// Unit normal of the facet of a, pointing out of a's element.
function facet_normal(a) =
    if n == 2 then normalize(cross(a@0.position - a.position,
                                   normalize(area_vector(a)) + normalize(area_vector(a@2@0))))
              else normalize(if dot(area_vector(a), a.position - centroid(a)) >= 0 then area_vector(a) else -area_vector(a));

pattern triangle(a, b, c)       { a -0.1- b -0.1- c -0.1- a; }
pattern quad(a, b, c, d)        { a -0.1- b -0.1- c -0.1- d -0.1- a; }
pattern tetrahedron(a, b, c, d) { dimension 3; triangle(a, b, c); a -2.1.0- d; }
)";

const std::string kInteractions = R"(
interaction stretch_spring on halfedge(a) {
    match a -0- b;
    param stiffness : real [N/m];
    param damping   : real [N s/m] = 0;
    param rest      : real [m] = norm(b.position - a.position);
    let d = b.position - a.position;
    let l = norm(d);
    let u = normalize(d);
    energy 0.5 * stiffness * (l - rest)^2;
    force  a on dart =  damping * dot(b.velocity - a.velocity, u) * u;
    force  b on dart = -damping * dot(b.velocity - a.velocity, u) * u;
}
interaction linear_shear_spring on face(a) {
    match quad(a, b, c, d);
    param stiffness : real [N/m];   param damping : real [N s/m] = 0;
    param rest_ac : real [m] = norm(c.position - a.position);
    param rest_bd : real [m] = norm(d.position - b.position);
    energy 0.5 * stiffness * ((norm(c.position - a.position) - rest_ac)^2
                            + (norm(d.position - b.position) - rest_bd)^2);
    force a, b, c, d on corner;
}
interaction linear_bending_spring on <2>(a) {
    match p -0.1- a -2- b -1.0- q;
    param stiffness : real [N/m];
    param rest : real [m] extensive = norm(q.position - p.position);
    energy 0.5 * stiffness * (norm(q.position - p.position) - rest)^2;
    force p, q on dart;
}
interaction area on face(a) {
    param stiffness : real [N/m^3];
    param rest : real [m^2] = norm(area_vector(a));
    energy 0.5 * stiffness * (norm(area_vector(a)) - rest)^2;
    force x in polygon(a) on dart;
}
interaction triangle_strain on element(a) {
    dimension 2;
    match triangle(a, b, c);
    first a where dot(area_vector(a), (0, 0, 1)) > 0;
    param modulus : real [Pa];
    energy modulus * norm(cross(b.position - a.position, c.position - a.position)) * (1 [m]);
    force a, b, c on corner;
    result stress : sym3 [Pa] = modulus * diagonal((1, 1, 0));
}
interaction tetrahedron_strain on element(a) {
    match tetrahedron(a, b, c, d);
    param modulus : real [Pa];
    let volume = dot(cross(b.position - a.position, c.position - a.position), d.position - a.position) / 6;
    energy modulus * volume;
    force a, b, c, d on corner;
    result stress : sym3 [Pa] = modulus * sym(identity3());
}
family strain = triangle_strain, tetrahedron_strain;
external interaction gravity on vertex(a) { param g : vec3 [m/s^2]; force a on vertex = a.mass * g; }
)";

const std::string kRules = R"(
rule separate_elements(a) {
    left  { a<0..n-2> -n- b<0..n-2>; }
    right { a -n- a;  b -n- b; }
}
rule sew_elements(a, b) { left { a<0..n-2> -n- a; b<0..n-2> -n- b; } right { a -n- b; } }
rule delete_element(a)  { left { a<0..n-1> -n- a; } right { } }
rule insert_vertex(a) {
    left  { a<0,2..n>; }
    right { a<_,2..n> -0- m<1,2..n>; }
    m.position = 0.5 * (a.position + a@0.position);
    m.velocity = 0.5 * (a.velocity + a@0.velocity);
    m.corner_mass = 0.25 * (a.corner_mass + a@0.corner_mass);
    a.corner_mass = 0.5 * a.corner_mass;
}
rule triangulate_face(a) {
    dimension 2;
    left  { a<0,1>; }
    right { a<0,_> -1- b<_,2> -0- c<1,2>; }
    c.position = mean(x in face(a) / corner : x.position);
    c.velocity = mean(x in face(a) / corner : x.velocity);
    a.corner_mass = a.corner_mass / 3;
    c.corner_mass = (a.corner_mass + a@0.corner_mass) / 3;
}
rule dual(a) {
    dimension 2;
    left { a<0,1,2>; }
    right { a<2,1,0>; }
    a.position = mean(x in face(a) / corner : x.position);
    a.velocity = mean(x in face(a) / corner : x.velocity);
    a.fixed = false;
    a.corner_mass = a.corner_mass;
}
rule yield(a) {
    left { a -0- b; }
    param limit : real;
    where norm(b.position - a.position) > limit * a.stretch_spring.rest;
    a.stretch_spring.rest = norm(b.position - a.position) / limit;
}
rule flatten(a) { left { a; } a.position = (a.position.x, a.position.y, 0); }
)";

const std::string kTearing = R"(
criterion atomic_facet_force on facet(a) {
    match  a -n- b;
    let    out = facet_normal(a);
    let    fa = sum(v in halffacet(a) / corner : force_on(corner(v)));
    let    fb = sum(v in halffacet(b) / corner : force_on(corner(v)));
    where  dot(fa, out) < 0 and dot(fb, out) > 0;
    value  abs(dot(fa - fb, out));
}
criterion spring_elongation of stretch_spring { value l / rest; }
criterion principal_stress on vertex(a) {
    let   e = max_eigenpair(a.vertex_stress);
    value e.value;
    result normal = e.vector;
}
criterion strongest on vertex(a) {
    let f = argmax(f in forces(vertex(a)) : norm(f) : f);
    value norm(f);
    result normal = f;
}
criterion by_spring on vertex(a) { value norm(force_on(vertex(a), stretch_spring)); }
criterion element_stress on element(a) { where has(a.strain); value max_eigenpair(a.strain.stress).value; }
operation split_vertex on vertex(a) {
    param normal : vec3;
    let side(x) = dot(centroid(x) - a.position, normal) >= 0;
    for x in vertex(a) / facet where not free(x, n) and side(x) != side(x@n) { apply separate_elements(x); }
}
operation remove_element on element(a) {
    for x in element(a) / facet where not free(x, n) { apply separate_elements(x); }
    apply delete_element(a);
}
operation relax on element(a) {
    if has(a.stretch_spring) { a.velocity = (0, 0, 0); apply yield(a; limit = 1.2); } else { apply remove_element(a); }
}
)";

}  // namespace

TEST_CASE("every kind of item of the language is accepted") {
  const auto checked =
      check_text(kData + kFunctions + kInteractions + kRules + kTearing, false);
  CHECK(checked.messages() == "");
  for (const int d : {2, 3}) {
    CAPTURE(d);
    const gmsim::check::RuleLibrary& library = checked.rules.in(d);
    CHECK(library.find_rule("separate_elements") != nullptr);
    CHECK(library.find_rule("insert_vertex") != nullptr);
    CHECK(library.find_operation("split_vertex") != nullptr);
    CHECK(library.find_operation("relax") != nullptr);
    CHECK(library.find_interaction("stretch_spring") != nullptr);
    CHECK(library.find_interaction("gravity") != nullptr);
    CHECK(library.find_criterion("atomic_facet_force") != nullptr);
    CHECK(library.find_criterion("element_stress") != nullptr);
    CHECK((library.find_interaction("triangle_strain") != nullptr) == (d == 2));
    CHECK((library.find_interaction("tetrahedron_strain") != nullptr) == (d == 3));
    CHECK((library.find_rule("dual") != nullptr) == (d == 2));
    REQUIRE(library.find_family("strain") != nullptr);
    CHECK(library.find_family("strain")->members.size() == 1);
  }
}

TEST_CASE("a chain needs springs and vertices only") {
  const auto checked = check_text(kData + kFunctions + kInteractions, false);
  CHECK(checked.messages() == "");
  const gmsim::check::RuleLibrary& library = checked.rules.in(1);
  CHECK(library.find_interaction("stretch_spring") != nullptr);
  CHECK(library.find_interaction("gravity") != nullptr);
  CHECK(library.find_interaction("linear_shear_spring") == nullptr);
  CHECK(checked.rules.why_absent("linear_shear_spring", 1) ==
        "there is no orbit `face` in dimension 1");
  CHECK(checked.rules.why_absent("linear_bending_spring", 1) == "there is no link 2 in dimension 1");
}

TEST_CASE("the standard library has no errors") {
  gmsim::support::SourceMap sources;
  gmsim::support::Diagnostics diagnostics;
  const auto rules = gmsim::check::check_rules({}, {}, sources, diagnostics);
  for (const auto& diagnostic : diagnostics.all()) CAPTURE(diagnostic.message);
  CHECK(diagnostics.all().empty());
  CHECK(rules.in(2).schema.find("position").has_value());
}
