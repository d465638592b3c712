// SPDX-License-Identifier: MIT
// Random expressions of the rule language, as text, of every kind and type.
#pragma once

#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace gmsim::tests {

/// What the expressions speak about; to be checked without the standard library.
inline const char* expression_rules() {
  return R"(
embedding position : vec3 on vertex;
embedding velocity : vec3 on vertex;
embedding r : real on face;
embedding w : real on corner;
embedding c : real on vertex = 1.5;
embedding k : int on edge;
embedding flag : bool on vertex;
embedding maybe : real on vertex optional;
embedding m : mat3 on dart;
embedding s : sym3 on face;
embedding p2 : vec2 on vertex;
embedding m2 : mat2 on halfedge;
embedding table : real[4] on face;
embedding vecs : vec3[2][3] on edge;
function area_vector(a) = 0.5 * sum(x in polygon(a) : cross(x.position, x@0.position));
function blend(x, y) = x * y - x;
function along(v, w) = dot(v, w) * normalize(w) + cross(v, w);
derived area : real on face(a) = norm(area_vector(a));
derived total : real on vertex(v) = sum(x in vertex(v) / corner : x.w * x.area);
)";
}

class RandomExpression {
 public:
  RandomExpression(std::uint32_t seed, int dimension) : random_(seed), dimension_(dimension) {}

  std::string real(int depth);
  std::string whole(int depth);
  std::string truth(int depth);
  std::string vec(int depth);
  std::string mat(int depth);
  std::string sym(int depth);
  std::string vec2(int depth);
  std::string mat2(int depth);

 private:
  std::size_t choose(std::size_t count) { return random_() % count; }
  std::string one_of(std::initializer_list<const char*> texts) {
    return texts.begin()[choose(texts.size())];
  }
  std::string call(const std::string& name, std::initializer_list<std::string> arguments) {
    std::string text = name + "(";
    for (const std::string& argument : arguments) text += (text.back() == '(' ? "" : ", ") + argument;
    return text + ")";
  }
  /// Bounded values for functions that need them.
  std::string positive(int depth) { return "(1.5 + abs(" + real(depth) + "))"; }
  std::string bounded(int depth) { return "(0.9 * tanh(" + real(depth) + "))"; }

  std::string dart() {
    std::string text = darts_[choose(darts_.size())];
    for (std::size_t i = choose(3); i > 0; --i) text += "@" + std::to_string(choose(dimension_ + 1));
    return text;
  }
  std::string collection() {
    const std::string d = dart();
    switch (choose(8)) {
      case 0: return "vertex(" + d + ")";
      case 1: return "vertex(" + d + ") / corner";
      case 2: return "face(" + d + ") / vertex";
      case 3: return "edge(" + d + ")";
      case 4: return "<0,1>(" + d + ") / halfedge";
      case 5: return "vertex(" + d + ") / edge";
      default: return "polygon(" + d + ")";
    }
  }
  /// fold(x in collection : body), with x in scope of the body.
  template <typename Body>
  std::string fold(const std::string& name, const Body& body) {
    const std::string variable = "x" + std::to_string(variables_++);
    std::string text = name + "(" + variable + " in " + collection() + " : ";
    darts_.push_back(variable);
    text += body();
    darts_.pop_back();
    return text + ")";
  }
  template <typename Value>
  std::string best(const Value& value, int depth) {
    return fold(one_of({"argmax", "argmin"}), [&] { return real(depth) + " : " + value(); });
  }
  template <typename Value>
  std::string choice(const Value& value, int depth) {
    return "(if " + truth(depth) + " then " + value() + " else " + value() + ")";
  }

  std::mt19937 random_;
  int dimension_;
  std::vector<std::string> darts_ = {"a"};
  int variables_ = 0;
};

inline std::string RandomExpression::real(int depth) {
  const int d = depth - 1;
  if (depth <= 0) {
    switch (choose(9)) {
      case 0: return one_of({"0.5", "2.0", "-0.25", "3.0", "1"});
      case 1: return dart() + ".w";
      case 2: return dart() + ".c";
      case 3: return dart() + ".area";
      case 4: return dart() + ".total";
      case 5: return one_of({"(time / 3.0 [s])", "(dt / 0.5 [s])", "step"});
      case 6: return "random(" + std::to_string(choose(3)) + ", " + one_of({"face", "vertex", "edge"}) + "(" + dart() + "))";
      default: return dart() + ".r";
    }
  }
  const auto sub = [&] { return real(d); };
  switch (choose(46)) {
    case 0: case 1: return "(" + sub() + " + " + sub() + ")";
    case 2: case 3: return "(" + sub() + " - " + sub() + ")";
    case 4: case 5: return sub() + " * " + sub();
    case 6: return sub() + " / " + positive(d);
    case 7: return "(-" + positive(d) + ")";
    case 8: return positive(d) + "^" + one_of({"2", "3", "0.5", "(-2)", "1.7", "(1/3)", "7", "1"});
    case 9: return choice(sub, d);
    case 10: return call("norm", {vec(d)});
    case 11: return call("dot", {vec(d), vec(d)});
    case 12: return "(" + vec(d) + ")." + one_of({"x", "y", "z"});
    case 13: return call("contract", {mat(d), mat(d)});
    case 14: return call("det", {mat(d)});
    case 15: return call("trace", {choose(2) == 0 ? mat(d) : sym(d)});
    case 16: return call("det", {sym(d)});
    case 17: return call("contract", {sym(d), sym(d)});
    case 18: case 19: return fold("sum", sub);
    case 20: return fold("mean", sub);
    case 21: return fold(one_of({"max", "min"}), sub);
    case 22: return best(sub, d);
    case 23: {
      const std::string i = "i" + std::to_string(variables_++);
      return "sum(" + i + " in 0..4 : " + dart() + ".table[" + i + "] * " + sub() + ")";
    }
    case 24: return call("real", {whole(d)});
    case 25: return call("real", {truth(d)});
    case 26: return call("blend", {sub(), sub()});
    case 27: return call("frozen", {sub()});
    case 28: return call(one_of({"max_eigenpair", "min_eigenpair"}), {sym(d)}) + ".value";
    case 29: return call("clamp", {sub(), one_of({"-1", "0.5", "2"}), one_of({"1", "0.25"})});
    case 30: return call(one_of({"min", "max"}), {sub(), sub()});
    case 31: return call(one_of({"abs", "sign", "floor", "ceil", "tanh", "atan", "sin", "cos"}), {sub()});
    case 32: return call("mod", {sub(), positive(d)});
    case 33: return call(one_of({"sqrt", "log"}), {positive(d)});
    case 34: return call(one_of({"exp", "tan", "asin", "acos"}), {bounded(d)});
    case 35: return call("atan2", {sub(), positive(d)});
    case 36: return call("norm", {vec2(d)});
    case 37: return call("dot", {vec2(d), vec2(d)});
    case 38: return "(" + vec2(d) + ")." + one_of({"x", "y"});
    case 39: return call(one_of({"det", "trace"}), {mat2(d)});
    case 40: return call("contract", {mat2(d), mat2(d)});
    case 41: {
      const std::string at = dart();
      return "(if has(" + at + ".maybe) then " + at + ".maybe else " + sub() + ")";
    }
    case 42: return "(if " + truth(0) + " then " + dart() + " else " + dart() + ").w";
    case 43: return whole(d) + " * " + sub();
    case 44: return fold(one_of({"argmax", "argmin"}), [&] { return "count(z in vertex(" + dart() + ")) : " + dart(); }) + ".r";
    default: return real(0);
  }
}

inline std::string RandomExpression::whole(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return whole(d); };
  switch (depth <= 0 ? choose(3) : choose(11)) {
    case 0: return dart() + ".k";
    case 1: return one_of({"1", "2", "3"});
    case 2: return "count(y in " + collection() + ")";
    case 3: return fold("count", [&] { return truth(d); });
    case 4: return "(" + sub() + one_of({" + ", " - ", " * "}) + sub() + ")";
    case 5: return call("mod", {sub(), "3"});
    case 6: return "abs(" + sub() + ")";
    case 7: return call(one_of({"min", "max"}), {sub(), sub()});
    case 8: return fold("sum", sub);
    case 9: return choice(sub, d);
    default: return fold(one_of({"max", "min"}), sub);
  }
}

inline std::string RandomExpression::truth(int depth) {
  const int d = depth - 1;
  if (depth <= 0) {
    switch (choose(4)) {
      case 0: return "free(" + dart() + ", " + std::to_string(choose(dimension_ + 1)) + ")";
      case 1: return "(" + dart() + " == " + dart() + ")";
      case 2: return "has(" + dart() + ".maybe)";
      default: return "(count(y in " + collection() + ") > " + std::to_string(choose(6)) + ")";
    }
  }
  switch (choose(10)) {
    case 0: case 1: return "(" + real(d) + one_of({" < ", " <= ", " > ", " >= "}) + real(d) + ")";
    case 2: return "(" + whole(d) + one_of({" == ", " != "}) + whole(d) + ")";
    case 3: return dart() + ".flag";
    case 4: return "(" + truth(d) + one_of({" and ", " or "}) + truth(d) + ")";
    case 5: return "(not " + truth(d) + ")";
    case 6: return fold(one_of({"any", "all"}), [&] { return truth(d); });
    case 7: return "(" + dart() + ".flag" + one_of({" == ", " != "}) + truth(d) + ")";
    case 8: return choice([&] { return truth(d); }, d);
    default: return truth(0);
  }
}

inline std::string RandomExpression::vec(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return vec(d); };
  switch (depth <= 0 ? choose(4) : choose(20)) {
    case 0: case 1: return dart() + ".position";
    case 2: return dart() + ".velocity";
    case 3: return dart() + ".vecs[" + std::to_string(choose(2)) + "][" + std::to_string(choose(3)) + "]";
    case 4: return "(" + sub() + one_of({" + ", " - "}) + sub() + ")";
    case 5: return "(-" + sub() + ")";
    case 6: return real(d) + " * " + sub();
    case 7: return sub() + " * " + positive(d);
    case 8: return sub() + " / " + positive(d);
    case 9: return call("cross", {sub(), sub()});
    case 10: return call("normalize", {sub()});
    case 11: return mat(d) + " * " + sub();
    case 12: return sym(d) + " * " + sub();
    case 13: return "(" + real(d) + ", " + real(d) + ", " + one_of({"0", "1", "0.5"}) + ")";
    case 14: return fold(one_of({"sum", "mean"}), sub);
    case 15: return choice(sub, d);
    case 16: return best(sub, d);
    case 17: return call(one_of({"max_eigenpair", "min_eigenpair"}), {sym(d)}) + ".vector";
    case 18: return call("along", {sub(), sub()});
    default: return "(if " + truth(d) + " then 0 else " + sub() + ")";
  }
}

inline std::string RandomExpression::mat(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return mat(d); };
  switch (depth <= 0 ? 0 : choose(14)) {
    case 0: return dart() + ".m";
    case 1: return call("outer", {vec(d), vec(d)});
    case 2: return call("columns", {vec(d), vec(d), vec(d)});
    case 3: return call("rows", {vec(d), vec(d), vec(d)});
    case 4: return "(" + sub() + one_of({" + ", " - "}) + "identity3())";
    case 5: return sub() + " * " + sub();
    case 6: return real(d) + " * " + sub();
    case 7: return call("transpose", {sub()});
    case 8: return "inverse(identity3() + 0.2 * " + dart() + ".m)";
    case 9: return call("mat", {sym(d)});
    case 10: return "polar_rotation(identity3() + 0.3 * " + dart() + ".m)";
    case 11: return fold(one_of({"sum", "mean"}), sub);
    case 12: return choice(sub, d);
    default: return sub() + " / " + positive(d);
  }
}

inline std::string RandomExpression::sym(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return sym(d); };
  switch (depth <= 0 ? 0 : choose(9)) {
    case 0: return dart() + ".s";
    case 1: return call("sym", {mat(d)});
    case 2: return call("diagonal", {vec(d)});
    case 3: return "(" + sub() + one_of({" + ", " - "}) + sub() + ")";
    case 4: return real(d) + " * " + sub();
    case 5: return "inverse(diagonal((3, 2, 4)) + 0.3 * " + dart() + ".s)";
    case 6: return fold("mean", sub);
    case 7: return choice(sub, d);
    default: return "(-" + sub() + ")";
  }
}

inline std::string RandomExpression::vec2(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return vec2(d); };
  switch (depth <= 0 ? 0 : choose(8)) {
    case 0: return dart() + ".p2";
    case 1: return "(" + real(d) + ", " + real(d) + ")";
    case 2: return "(" + sub() + one_of({" + ", " - "}) + sub() + ")";
    case 3: return real(d) + " * " + sub();
    case 4: return call("normalize", {sub()});
    case 5: return mat2(d) + " * " + sub();
    case 6: return fold("sum", sub);
    default: return choice(sub, d);
  }
}

inline std::string RandomExpression::mat2(int depth) {
  const int d = depth - 1;
  const auto sub = [&] { return mat2(d); };
  switch (depth <= 0 ? 0 : choose(8)) {
    case 0: return dart() + ".m2";
    case 1: return call("rows", {vec2(d), vec2(d)});
    case 2: return "(identity2()" + one_of({" + ", " - "}) + sub() + ")";
    case 3: return sub() + " * " + sub();
    case 4: return call("transpose", {sub()});
    case 5: return "inverse(2 * identity2() + 0.1 * " + dart() + ".m2)";
    case 6: return choice(sub, d);
    default: return real(d) + " * " + sub();
  }
}

}  // namespace gmsim::tests
