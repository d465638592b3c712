// SPDX-License-Identifier: MIT
#include "samples.h"

namespace gmsim::syntax {

const std::vector<Sample> kExpressions = {
    // Literals.
    {"1", "1"},
    {"1.50", "1.50"},
    {"1e-3", "1e-3"},
    {"1.5e6", "1.5e6"},
    {"2E+3", "2E+3"},
    {"true", "true"},
    {"(false)", "false ()"},
    {"n", "n"},
    {"0.5 [N]", "number 0.5 [N]"},
    {"3 [1]", "number 3 [1]"},
    {"3 [1/s]", "number 3 [1/s]"},
    {"9.81 [m/s^2]", "number 9.81 [m/s^2]"},
    {"1 [N s/m]", "number 1 [N s/m]"},
    {"1 [kg m^2/s^2]", "number 1 [kg m^2/s^2]"},
    {"1 [N/(m s)]", "number 1 [N/(m s)]"},
    {"1 [m^-1]", "number 1 [1/m]"},
    {"1 [m^-1 N]", "number 1 [m^-1 N]"},
    {"1 [m^(1/2)]", "number 1 [m^(1/2)]"},
    {"1 [N m^(-1/2)]", "number 1 [N/m^(1/2)]"},
    {"(0, 0, 0)", "(tuple 0 0 0)"},
    {"(0, 0, -9.81) [m/s^2]", "(tuple [m/s^2] 0 0 (minus 9.81))"},
    // Precedence, lowest first.
    {"a or b and c", "(or a (and b c))"},
    {"not a and b", "(and (not a) b)"},
    {"not a == b", "(not (== a b))"},
    {"not not a", "(not (not a))"},
    {"a == not b", "(== a (not b))"},
    {"a < b and c >= d", "(and (< a b) (>= c d))"},
    {"a + b < c * d", "(< (+ a b) (* c d))"},
    {"a - b - c", "(- (- a b) c)"},
    {"a + b * c", "(+ a (* b c))"},
    {"a / b / c", "(/ (/ a b) c)"},
    {"-a * b", "(* (minus a) b)"},
    {"-a^2", "(minus (^ a 2))"},
    {"--a", "(minus (minus a))"},
    {"a^b^c", "(^ a (^ b c))"},
    {"a^-b * c", "(* (^ a (minus b)) c)"},
    {"2^-3", "(^ 2 (minus 3))"},
    {"-a.x", "(minus (member x a))"},
    {"a.x^2", "(^ (member x a) 2)"},
    {"(a + b) * c", "(* (+ () a b) c)"},
    {"a != b or c <= d or e > f", "(or (or (!= a b) (<= c d)) (> e f))"},
    // What follows an operand.
    {"a@0", "(walk 0 a)"},
    {"a@n", "(walk n a)"},
    {"a@(n-1)", "(walk n-1 a)"},
    {"a@(2)", "(walk 2 a)"},
    {"a@0@1@0", "(walk 0 (walk 1 (walk 0 a)))"},
    {"a@0.position", "(member position (walk 0 a))"},
    {"a@10.x", "(member x (walk 10 a))"},
    {"a@n - 1", "(- (walk n a) 1)"},
    {"a - 0 - b", "(- (- a 0) b)"},
    {"a.stretch_spring.rest", "(member rest (member stretch_spring a))"},
    {"a.position.x", "(member x (member position a))"},
    {"k[i]", "(index k i)"},
    {"k[i][0].y", "(member y (index (index k i) 0))"},
    {"k[1 + 2]", "(index k (+ 1 2))"},
    {"(a)[m]", "(index name a () m)"},
    {"f(x)[m]", "(index (call f x) m)"},
    {"(1, 2, 3).y", "(member y (tuple 1 2 3))"},
    {"vertex(a) / corner", "(/ (call vertex a) corner)"},
    {"vertex(a) / <1>", "(/ (call vertex a) orbit <1>)"},
    {"vertex(a) / <1..n>", "(/ (call vertex a) orbit <1..n>)"},
    {"<2>(a)", "(orbit <2> a)"},
    {"<>(a)", "(orbit <> a)"},
    {"<0..n-2,n>(a@n)", "(orbit <0..n-2,n> (walk n a))"},
    {"a < <2>(b)", "(< a (orbit <2> b))"},
    {"all vertex", "all vertex"},
    {"all <1,2>", "all <1,2>"},
    // Calls and folds.
    {"f()", "call f"},
    {"max(a, b)", "(call max a b)"},
    {"max(x in A : x.t)", "(fold max x A (member t x))"},
    {"count(x in A)", "(fold count x A)"},
    {"sum(x in vertex(v) / corner : x.m)", "(fold sum x (/ (call vertex v) corner) (member m x))"},
    {"sum(i in 0..8 : k[i])", "(fold sum i (range 0 8) (index k i))"},
    {"sum(i in 0..n-2 : i)", "(fold sum i (range 0 (- n 2)) i)"},
    {"sum(i in a + 1..f(b) : i)", "(fold sum i (range (+ a 1) (call f b)) i)"},
    {"argmax(f in forces(vertex(a)) : norm(f) : f)",
     "(fold argmax f (call forces (call vertex a)) (call norm f) f)"},
    {"max(x in all vertex : -x.position.z)",
     "(fold max x all vertex (minus (member z (member position x))))"},
    {"all(x in A : x.fixed)", "(fold all x A (member fixed x))"},
    {"sum(x in A : if b then 1 else 2)", "(fold sum x A (if b 1 2))"},
    // Conditions stand at the top and in parentheses.
    {"if n == 2 then a else b", "(if (== n 2) a b)"},
    {"if a then b else if c then d else e", "(if a b (if c d e))"},
    {"if if a then b else c then d else e", "(if (if a b c) d e)"},
    {"if a then b else c + d", "(if a b (+ c d))"},
    {"1 + (if a then b else c)", "(+ 1 (if () a b c))"},
    {"f(if a then b else c, d)", "(call f (if a b c) d)"},
    {"normalize(if dot(u, v) >= 0 then u else -u)",
     "(call normalize (if (>= (call dot u v) 0) u (minus u)))"},
    // Every word but the reserved ones can be a name, and any word after a dot.
    {"value + energy * force", "(+ value (* energy force))"},
    {"left.right", "(member right left)"},
    {"all + 1", "(+ all 1)"},
    {"-all", "(minus all)"},
    {"f(all, first, result)", "(call f all first result)"},
    {"sum(merge in split : merge.of)", "(fold sum merge split (member of merge))"},
    {"a.n", "(member n a)"},
    {"a.where.if.param.for", "(member for (member param (member if (member where a))))"},
    {"a.match + a.sum", "(+ (member match a) (member sum a))"},
    {"rule(operation)", "(call rule operation)"},
    {"_a + a_1", "(+ _a a_1)"},
    // Layout and comments.
    {" a// to the end\n+ /* in between */ b", "(+ a b)"},
    {"a /* a // b */ / b", "(/ a b)"},
    {"a+/***/b", "(+ a b)"},
    {"a\r\n+\tb\r\n", "(+ a b)"},
};

const std::vector<Sample> kItems = {
    {R"(import "wind.rule";)", "import \"wind.rule\"\n"},
    {R"(import "a\\b\"c";)", "import \"a\\\\b\\\"c\"\n"},
    {"dimension 2;", "dimension 2\n"},
    {"orbit corner = <1..n-1>;", "orbit corner = <1..n-1>\n"},
    {"orbit facet = <0..n-2,n>;", "orbit facet = <0..n-2,n>\n"},
    {"orbit point = vertex;", "orbit point = vertex\n"},
    {"orbit one = <>;", "orbit one = <>\n"},
    {"/// One.\n///\n/// Two.\norbit dart = <>;",
     "orbit dart = <>\n  doc \"One.\"\n  doc \"\"\n  doc \"Two.\"\n"},
    {"// no doc\n//// no doc either\n///doc\norbit dart = <>;", "orbit dart = <>\n  doc \"doc\"\n"},
    {"embedding position : vec3 [m] on vertex merge mean;",
     "embedding position : vec3 [m] on vertex\n  merge mean\n"},
    {"embedding velocity : vec3 [m/s] on vertex merge mean = (0, 0, 0);",
     "embedding velocity : vec3 [m/s] on vertex\n  merge mean\n  default\n    tuple\n"
     "      number 0\n      number 0\n      number 0\n"},
    {"embedding fixed : bool on vertex merge max = false;",
     "embedding fixed : bool on vertex\n  merge max\n  default\n    false\n"},
    {"embedding corner_mass : real [kg] on corner extensive;",
     "embedding corner_mass : real [kg] on corner\n  extensive\n"},
    {"embedding m : real on <1,2> extensive split area(a) merge first optional;",
     "embedding m : real on <1,2> optional\n  extensive\n    split\n      call area\n        name "
     "a\n"
     "  merge first\n"},
    {"embedding m : real on <1,2> optional merge equal intensive;",
     "embedding m : real on <1,2> optional\n  intensive\n  merge equal\n"},
    {"embedding k : mat3[4][8] [N/m] on element;", "embedding k : mat3[4][8] [N/m] on element\n"},
    {"embedding k : real[8] on element;", "embedding k : real[8] on element\n"},
    {"embedding k : real [1] on element;", "embedding k : real [1] on element\n"},
    {"embedding k : real[8][1] on element;", "embedding k : real[8] [1] on element\n"},
    {"embedding k : real [m^(3/2)] on element;", "embedding k : real [m^(3/2)] on element\n"},
    {"derived mass : real [kg] on vertex(v) = sum(c in vertex(v) / corner : c.corner_mass);",
     "derived mass : real [kg] on vertex(v)\n  fold sum c\n    /\n      call vertex\n"
     "        name v\n      name corner\n    member corner_mass\n      name c\n"},
    {"function one() = 1;", "function one()\n  number 1\n"},
    {"function f(a, b) = if a then b else 0;",
     "function f(a, b)\n  if\n    name a\n    name b\n    number 0\n"},
    {"pattern triangle(a, b, c) { a -0.1- b -0.1- c -0.1- a; }",
     "pattern triangle(a, b, c)\n  a -0.1- b -0.1- c -0.1- a;\n"},
    {"pattern tetrahedron(a, b) { dimension 3; triangle(a, b); a -2.1.0- b; }",
     "pattern tetrahedron(a, b)\n  dimension 3;\n  triangle(a, b);\n  a -2.1.0- b;\n"},
    {"pattern p() { }", "pattern p()\n"},
    {"pattern paths(a, b) { a -n- b; a -n-1- b; a - n - 1 - b; a -0.n-1.0- b; a -n-1.n- b; }",
     "pattern paths(a, b)\n  a -n- b;\n  a -n-1- b;\n  a -n-1- b;\n  a -0.n-1.0- b;\n"
     "  a -n-1.n- b;\n"},
    {"pattern words(left, value) { dimension; left -0- value; match(left); right<_>; }",
     "pattern words(left, value)\n  dimension;\n  left -0- value;\n  match(left);\n  right<_>;\n"},
    {"rule corner() { left { } right { a<0,_,2..n> -1- b<>; } }",
     "rule corner()\n  left\n  right\n    a<0,_,2..n> -1- b<>;\n"},
    {"rule separate(a) { left { a<0..n-2> -n- b<0..n-2>; } right { a -n- a; b -n- b; } }",
     "rule separate(a)\n  left\n    a<0..n-2> -n- b<0..n-2>;\n  right\n    a -n- a;\n"
     "    b -n- b;\n"},
    {"rule r(a) { dimension 2; left { a -0- b; } param limit : real = 2; where a.x > limit;"
     " let u = a.x; a.spring.rest = u / limit; a@0.x = 1; }",
     "rule r(a)\n  dimension 2\n  left\n    a -0- b;\n  param limit : real\n    default\n"
     "      number 2\n  where\n    >\n      member x\n        name a\n      name limit\n"
     "  let u\n    member x\n      name a\n"
     "  assign\n    member rest\n      member spring\n        name a\n    /\n      name u\n"
     "      name limit\n"
     "  assign\n    member x\n      walk 0\n        name a\n    number 1\n"},
    {"rule words(value) { left { value<0>; } value.energy = 1; first.if = 2; match.in.n = 3; }",
     "rule words(value)\n  left\n    value<0>;\n  assign\n    member energy\n      name value\n"
     "    number 1\n  assign\n    member if\n      name first\n    number 2\n"
     "  assign\n    member n\n      member in\n        name match\n    number 3\n"},
    {"interaction spring on halfedge(a) { match a -0- b; energy 1; force a, b on dart; }",
     "interaction spring on halfedge(a)\n  match\n    a -0- b;\n  energy\n    number 1\n"
     "  force a, b on dart\n"},
    {"interaction s on <2>(a) { match p -0.1- a -2- b -1.0- q; force p on <> = -a.x; }",
     "interaction s on <2>(a)\n  match\n    p -0.1- a -2- b -1.0- q;\n  force p on <>\n"
     "    value\n      minus\n        member x\n          name a\n"},
    {"interaction q on face(a) { match quad(a, b, c, d); first d where d.x > 0; }",
     "interaction q on face(a)\n  match\n    quad(a, b, c, d);\n  first d\n    >\n"
     "      member x\n        name d\n      number 0\n"},
    {"interaction q on face(a) { match { quad(a, b, c, d); a -2- e; } }",
     "interaction q on face(a)\n  match\n    quad(a, b, c, d);\n    a -2- e;\n"},
    {"external interaction gravity on vertex(a) { param g : vec3 [m/s^2];"
     " force a on vertex = a.mass * g; }",
     "external interaction gravity on vertex(a)\n  param g : vec3 [m/s^2]\n  force a on vertex\n"
     "    value\n      *\n        member mass\n          name a\n        name g\n"},
    {"interaction p on face(a) { force x in polygon(a) on dart; force y in polygon(a) on dart = u; "
     "}",
     "interaction p on face(a)\n  force x on dart\n    in\n      call polygon\n        name a\n"
     "  force y on dart\n    in\n      call polygon\n        name a\n    value\n      name u\n"},
    {"interaction e on element(a) { param rest : real [m] merge mean extensive split w(a) = l(a);"
     " param p : real intensive; param q : real extensive merge mean;"
     " result stress : sym3 [Pa] = 2 * e; }",
     "interaction e on element(a)\n  param rest : real [m]\n    extensive\n      split\n"
     "        call w\n          name a\n    merge mean\n    default\n      call l\n        name a\n"
     "  param p : real\n    intensive\n  param q : real\n    extensive\n    merge mean\n"
     "  result stress : sym3 [Pa]\n    *\n      number 2\n      name e\n"},
    {"family elements = triangle, quad;", "family elements = triangle, quad\n"},
    {"criterion elongation of spring { value l / rest; }",
     "criterion elongation of spring\n  value\n    /\n      name l\n      name rest\n"},
    {"criterion of of of { value of; }", "criterion of of of\n  value\n    name of\n"},
    {"criterion stress on vertex(a) { let e = f(a.s); value e.value; result normal = e.vector; }",
     "criterion stress on vertex(a)\n  let e\n    call f\n      member s\n        name a\n"
     "  value\n    member value\n      name e\n  result normal\n    member vector\n"
     "      name e\n"},
    {"operation split on vertex(a) { param normal : vec3; let side(x) = x.y >= 0;"
     " for x in vertex(a) / facet where not free(x, n) { apply separate(x); } }",
     "operation split on vertex(a)\n  param normal : vec3\n  let side(x)\n    >=\n"
     "      member y\n        name x\n      number 0\n  for x\n    in\n      /\n"
     "        call vertex\n          name a\n        name facet\n    where\n      not\n"
     "        call free\n          name x\n          n\n    apply separate\n      name x\n"},
    {"operation o on face(a) { for i in 0..3 { } if a.b { a.c = 1; } else if d { } else { apply "
     "r(); }"
     " apply s(a, a@2; limit = 3, k = 1 + 2); apply t(; k = 1); }",
     "operation o on face(a)\n  for i\n    in\n      range\n        number 0\n        number 3\n"
     "  if\n    member b\n      name a\n    assign\n      member c\n        name a\n"
     "      number 1\n  else\n    if\n      name d\n    else\n      apply r\n"
     "  apply s\n    name a\n    walk 2\n      name a\n    parameter limit\n      number 3\n"
     "    parameter k\n      +\n        number 1\n        number 2\n"
     "  apply t\n    parameter k\n      number 1\n"},
    {"rule rule(of) { let all = 1; where (all) < 2; }",
     "rule rule(of)\n  let all\n    number 1\n  where\n    <\n      name all ()\n      number 2\n"},
    {"", ""},
    {"// nothing but a comment", ""},
};

}  // namespace gmsim::syntax
