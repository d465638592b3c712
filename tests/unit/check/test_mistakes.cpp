// SPDX-License-Identifier: MIT
// One row for each mistake: the text with the wrong place between « and », and the kind of the message.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check_text.h"

namespace {

struct Row {
  std::string kind;
  std::string text;
};

std::string without_marks(const std::string& text) {
  std::string plain = text;
  for (const std::string mark : {"«", "»"})
    for (std::size_t at; (at = plain.find(mark)) != std::string::npos;)
      plain.erase(at, mark.size());
  return plain;
}

std::string marked(const std::string& text) {
  const std::string open = "«", close = "»";
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find(close) - begin);
}

std::size_t marked_offset(const std::string& text) { return text.find("«"); }

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const auto checked = gmsim::check_tests::check_text(without_marks(row.text));
    const std::vector<std::string> errors = checked.errors();
    CAPTURE(checked.messages());
    REQUIRE(errors.size() == 1);
    CHECK(errors[0] == row.kind + "|" + marked(row.text));
    CHECK(checked.diagnostics.all()[0].place->begin == marked_offset(row.text));
  }
}

/// A rule on an edge of two darts around `body`.
std::string in_rule(const std::string& body) {
  return "rule r(a) { left { a -0- b; } param p : real; " + body + " }";
}
/// An interaction with nodes a and b around `body`.
std::string in_law(const std::string& body) {
  return "interaction i on halfedge(a) { match a -0- b; param k : real [N/m]; " + body + " }";
}
/// An operation around `body`.
std::string in_operation(const std::string& body) {
  return "rule cut(a) { left { a<0..n-2> -n- b<0..n-2>; } right { a -n- a; b -n- b; } }"
         " rule relax(a) { left { a; } param rate : real [1/s]; where rate > 0; }"
         " operation o on vertex(a) { " + body + " }";
}

}  // namespace

TEST_CASE("a name that is not known is reported where it stands") {
  check_rows({
      {"unknown-name", in_rule("where «q» > 0;")},
      {"unknown-name", in_rule("where «position» == 1;")},
      {"unknown-embedding", in_rule("where norm(a.«velocty») > 0;")},
      {"unknown-embedding", in_law("energy 0.5 * k * dot(a.«posit», b.position); force a, b on dart;")},
      {"unknown-function", in_rule("where «nrm»(a.position) > 0;")},
      {"unknown-function", in_rule("where «relax»(a) > 0;")},
      {"unknown-orbit", "embedding e : real on «vertx» = 0;"},
      {"unknown-type", "embedding e : «reel» on vertex = 0;"},
      {"unknown-unit", "embedding e : real [«kgg»] on vertex = 0;"},
      {"unknown-name", "embedding e : real on vertex merge «avg» = 0;"},
      {"unknown-item", "interaction i on face(a) { match «quadd»(a, b); param k : real; energy k; }"},
      {"unknown-item", "family f = «spring»;"},
      {"unknown-item", "criterion c of «spring» { value 1; }"},
      {"unknown-item", in_operation("apply «cutt»(a);")},
      {"unknown-name", in_operation("apply relax(a; «rat» = 1);")},
      {"unknown-name", "rule r(«c») { left { a -0- b; } }"},
      {"unknown-name", in_law("force a, «c» on dart = (0, 0, 0);")},
      {"unknown-embedding", in_law("force a on dart = a.i.«rest» * a.position;")},
      {"unknown-name", "function f(a) = «b»;"},
      {"unknown-embedding", "function f(a) = a.«nothing»;"},
      {"unknown-name", "pattern p(a, b, «c») { a -0- b; }"},
      {"unknown-embedding", in_operation("let f(x) = x.«side»; if f(a) == 1 { apply cut(a); }")},
  });
}

TEST_CASE("a name that is taken is reported at its second place") {
  check_rows({
      {"duplicate-name", "function f(a) = 1; function «f»(b) = 2;"},
      {"duplicate-name", "function «vertex»(a) = 1;"},
      {"duplicate-name", "function «norm»(a) = 1;"},
      {"duplicate-name", "embedding «mass» : real on vertex = 0;"},
      {"duplicate-name", "rule r(a) { left { a; } } operation «r» on vertex(a) { }"},
      {"duplicate-name", in_rule("let «a» = 1;")},
      {"duplicate-name", in_rule("let «dt» = 1;")},
      {"duplicate-name", in_rule("param «p» : real;")},
      {"duplicate-name", in_rule("where sum(«b» in vertex(a) : 1) > 0;")},
      {"duplicate-name", "function f(a, «a») = 1;"},
      {"duplicate-name", "pattern p(a, «a») { a -0- a; }"},
      {"duplicate-name", in_operation("apply relax(a; rate = 1, «rate» = 2);")},
      {"duplicate-name", "criterion c on vertex(a) { param «threshold» : real; value 1; }"},
      {"duplicate-node", "rule r(a) { left { a<0> -1- b; a«<0>» -2- b; } }"},
      {"duplicate-node", "rule r(a, «a») { left { a; } }"},
      {"duplicate-node", "pattern t(a, b) { a -0- b; } rule r(a) { left { t(a, «a»); } }"},
      {"conflict", "orbit edge = «<1>»;"},
  });
}

TEST_CASE("types that do not fit are reported at the narrowest place") {
  check_rows({
      {"type-mismatch", in_rule("where «p + 1»;")},
      {"type-mismatch", in_rule("where a.position «*» b.position == 0;")},
      {"type-mismatch", in_rule("where p «+» a.position == 0;")},
      {"type-mismatch", in_rule("where a.position «<» b.position;")},
      {"type-mismatch", in_rule("where dot(a.position, «p») > 0;")},
      {"type-mismatch", in_rule("where norm(«a») > 0;")},
      {"type-mismatch", in_rule("where a.position.«w» > 0;")},
      {"type-mismatch", in_rule("where p.«position» == 0;")},
      {"type-mismatch", in_rule("where «vertex(a)»;")},
      {"type-mismatch", in_rule("where sum(x in «a» : 1) > 0;")},
      {"type-mismatch", in_rule("where not «p»;")},
      {"type-mismatch", in_rule("where (if p > 0 then a.position else «p») == 0;")},
      {"type-mismatch", in_rule("a.position = «1»;")},
      {"type-mismatch", in_rule("a.position = «(1, 2)»;")},
      {"type-mismatch", in_rule("a.position = «(1, 2, 3, 4)»;")},
      {"type-mismatch", in_rule("where min(x in vertex(a) : «x.position») == 0;")},
      {"type-mismatch", in_rule("where vertex(a).«position» == 0;")},
      {"type-mismatch", in_rule("where count(x in vertex(a) / «p») > 0;")},
      {"type-mismatch", in_rule("where has(«a»);")},
      {"type-mismatch", "function f(a) = a.mass; " + in_rule("where f(«p») > 0;")},
      {"type-mismatch", "function f(x) = x + 1; " + in_rule("where «f(a.position)» == 0;")},
      {"type-mismatch", "function f(a) = norm(«a@0»);"},
      {"type-mismatch", in_law("energy «a.position»; force a on dart;")},
      {"type-mismatch", in_law("force «k» on dart = (0, 0, 0);")},
      {"type-mismatch", in_law("force a on dart = grad(k, «k»);")},
      {"type-mismatch", in_law("force a on dart = a.«i»;")},
      {"type-mismatch", "criterion c on vertex(a) { value «a.position»; }"},
      {"type-mismatch", in_operation("for f in «forces(vertex(a))» { apply cut(a); }")},
      {"type-mismatch", in_operation("apply cut(«a.position»);")},
  });
}

TEST_CASE("units that do not agree are reported") {
  check_rows({
      {"unit-mismatch", in_rule("where norm(a.position) «>» norm(a.velocity);")},
      {"unit-mismatch", in_rule("where norm(a.position «+» a.velocity) > 0;")},
      {"unit-mismatch", in_rule("where norm(a.position) «>» 3 [s];")},
      {"unit-mismatch", in_rule("a.position = «a.velocity»;")},
      {"unit-mismatch", in_rule("where exp(«a.mass») > 0;")},
      {"unit-mismatch", in_rule("where «min»(a.mass, a.position.x) > 0;")},
      {"unit-mismatch", in_rule("where 2 ^ «(3 [m])» > 0;")},
      {"unit-mismatch", in_rule("where (a.mass ^ «(1 / 7.1)») > 0;")},
      {"unit-mismatch", "embedding e : bool [«m»] on vertex = true;"},
      {"unit-mismatch", "embedding e : real [m] on vertex = «2 [s]»;"},
      {"unit-mismatch", in_law("energy «k * a.position.x»; force a on dart;")},
      {"unit-mismatch", in_law("force a on dart = «a.position»;")},
      {"unit-mismatch", in_law("param r : real [m] = «norm(a.velocity)»; force a on dart = (0, 0, 0);")},
      {"unit-mismatch", in_operation("apply relax(a; rate = «2 [s]»);")},
      {"unit-mismatch", in_rule("where norm(«(1 [m], 2 [s], 0)») > 0;")},
  });
}

TEST_CASE("counts, indices and constants") {
  check_rows({
      {"argument-count", in_rule("where «norm»(a.position, b.position) > 0;")},
      {"argument-count", in_rule("where «vertex»(a, b) == 0;")},
      {"argument-count", in_rule("where «free»(a);")},
      {"argument-count", "function f(a) = 1; " + in_rule("where «f»(a, b) > 0;")},
      {"argument-count", "pattern t(a, b) { a -0- b; } rule r(a) { left { «t»(a); } }"},
      {"argument-count", in_rule("where «sum»(x in vertex(a)) > 0;")},
      {"argument-count", in_rule("where «argmax»(x in vertex(a) : 1) > 0;")},
      {"argument-count", in_operation("apply «cut»(a, a@0);")},
      {"argument-count", in_operation("apply «relax»(a);")},
      {"bad-index", "embedding e : real[4] on vertex = 0; rule r(a) { left { a; } where a.e[«4»] > 0; }"},
      {"bad-index", "embedding e : real[4] on vertex = 0;"
                    "rule r(a) { left { a; } where sum(i in 0..5 : a.e[«i»]) > 0; }"},
      {"bad-index", "embedding e : «real[5000]» on vertex = 0;"},
      {"not-constant", in_rule("where 2 ^ «p» > 0;")},
      {"not-constant", in_rule("where free(a, «count(x in vertex(a))»);")},
      {"not-constant", "embedding e : real [s] on vertex = «time»;"},
  });
}

TEST_CASE("definitions in a circle are reported once") {
  check_rows({
      {"recursive-definition", "function f(a) = «f»(a@0);"},
      {"recursive-definition", "function f(a) = g(a); function g(a) = «f»(a);"},
      {"recursive-definition", "pattern p(a, b) { «p»(a, b); }"},
      {"recursive-definition", "pattern p(a, b) { q(a, b); } pattern q(a, b) { «p»(a, b); }"},
      {"recursive-definition", "derived d : real on vertex(v) = 1 + «v.d»;"},
      {"recursive-definition",
       "derived d : real on vertex(v) = «v.e»; derived e : real on vertex(v) = v.d;"},
      {"recursive-definition", "operation o on vertex(a) { apply «o»(a); }"},
      {"recursive-definition",
       "operation o on vertex(a) { apply q(a); } operation q on vertex(a) { apply «o»(a); }"},
      {"recursive-definition", in_law("force a on dart = «force_on(vertex(a))»;")},
      {"recursive-definition",
       "derived push : vec3 [N] on vertex(v) = force_on(vertex(v));"
       "derived twice : vec3 [N] on vertex(v) = 2 * v.push;" +
           in_law("force a on dart = «a.twice»;")},
  });
}

TEST_CASE("rules assign to embeddings of nodes that they have") {
  check_rows({
      {"bad-assignment", in_rule("a.«mass» = 1;")},
      {"bad-assignment", in_rule("«a@0.position» = (0, 0, 0);")},
      {"bad-assignment", in_rule("«a.position.x» = 1;")},
      {"bad-assignment", in_rule("«c».position = (0, 0, 0);")},
      {"bad-assignment", in_law("force a on dart = (0, 0, 0);") +
                             "rule r(a) { left { a -0- b; } a.«i» = true; }"},
      {"bad-assignment", "interaction i on halfedge(a) { result r : real = 1; force a on dart = "
                         "(0, 0, 0); } rule r(a) { left { a; } a.i.«r» = 2; }"},
      {"bad-assignment", in_operation("«a.mass» = 1;")},
      {"bad-assignment", in_operation("«a.position.x» = 1;")},
      {"bad-assignment", "rule r(a) { dimension 2; left { a<0,1> -2- a; } right { } «a».position = (0, 0, 0); }"},
      {"new-node-read",
       "rule r(a) { dimension 2; left { a<0,2>; } right { a<_,2> -0- m<1,2>; }"
       " m.position = «m».velocity; }"},
      {"path-in-right", "rule r(a) { dimension 2; left { a -0- b; } right { a «-0.1-» b; } }"},
  });
}

TEST_CASE("statements stand where they mean something") {
  check_rows({
      {"bad-item", in_rule("«energy» 1;")},
      {"bad-item", in_rule("«match» a -0- b;")},
      {"bad-item", in_law("«left» { a; } force a on dart = (0, 0, 0);")},
      {"bad-item", in_operation("«where» true;")},
      {"bad-item", "rule «r»(a) { where true; }"},
      {"bad-item", "criterion «c» on vertex(a) { }"},
      {"bad-item", "interaction «i» on vertex(a) { param k : real; }"},
      {"bad-item", "interaction i on halfedge(«a») { match p -0- q; force p on dart = (0, 0, 0); }"},
      {"bad-item", in_law("result «r» = 1; force a on dart = (0, 0, 0);")},
      {"bad-item", in_rule("where count(x in «all vertex») > 0;")},
      {"bad-item", in_rule("param q : real «extensive»;")},
      {"bad-item", "orbit o = <0, «_»>;"},
      {"conflict", in_law("energy 1 [J]; «energy» 2 [J]; force a on dart;")},
      {"conflict", "rule r(a) { left { a; } «left» { a; } }"},
      {"conflict", "embedding e : bool on vertex «extensive» = true;"},
      {"conflict", "embedding e : real on vertex extensive merge «mean» = 0;"},
      {"conflict", "embedding e : vec3 on vertex merge «max» = 0;"},
      {"conflict", "dimension 2; rule r(a) { «dimension 3;» left { a; } }"},
  });
}

TEST_CASE("an interaction gives a force wherever its energy pulls") {
  check_rows({
      {"force-missing", in_law("energy k * dot(a.position, «b.position»); force a on dart;")},
      {"force-missing", in_law("let d = «b.position» - a.position; energy k * dot(d, d); force a on dart;")},
      {"force-missing", in_law("energy k * dot(a.position, «a@1@0.position»); force a, b on dart;")},
      {"force-missing", "interaction i on face(a) { dimension 2; param k : real;"
                        " energy k * sum(x in polygon(a) : dot(«x.position», x.position)); force a on dart; }"},
      {"force-orbit", in_law("force a on «edge» = (0, 0, 0);")},
      {"not-differentiable", in_law("energy «floor(a.mass)» * (1 [m^2/s^2]); force a on dart;")},
      {"not-differentiable", in_law("force a on dart = grad(k * «a.spread»^2 , a.position);") +
                                 "derived spread : real [m] on vertex(v) = norm(v.position);"},
      {"not-differentiable",
       "derived far : real [m] on vertex(v) = norm(v.position);" +
           in_law("energy k * «a.far»^2; force a on dart;")},
  });
}
