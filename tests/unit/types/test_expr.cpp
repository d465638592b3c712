// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <random>

#include "types/expr.h"

using namespace gmsim::types;

namespace {

ExprNames names() {
  return {{"a", "b", "x", "d"}, {"position", "mass"}, {"stretch_spring"}};
}

ExprPtr make(ExprKind kind, std::vector<ExprPtr> args = {}) {
  Expr expr;
  expr.kind = kind;
  expr.args = std::move(args);
  return std::make_shared<Expr>(std::move(expr));
}

/// A copy of `expr` with one payload set.
template <typename Member, typename Payload>
ExprPtr with(const ExprPtr& expr, Member member, Payload payload) {
  Expr copy = *expr;
  copy.*member = payload;
  return std::make_shared<Expr>(std::move(copy));
}

ExprPtr local(std::uint32_t slot) {
  return with(make(ExprKind::Local), &Expr::slot, Slot{slot});
}
ExprPtr literal(Value value) {
  return with(make(ExprKind::Literal), &Expr::value, std::move(value));
}
ExprPtr number(double x) {
  return literal(Value::real(x));
}
ExprPtr position(ExprPtr dart) {
  return make(ExprKind::Embedding, {std::move(dart)});
}
ExprPtr alpha(ExprPtr dart, int i) {
  return with(make(ExprKind::Alpha, {std::move(dart)}), &Expr::number, i);
}
ExprPtr orbit(ExprKind kind, std::vector<ExprPtr> args, OrbitType type) {
  return with(make(kind, std::move(args)), &Expr::orbit, type);
}
std::string shown(const ExprPtr& expr) {
  return to_string(*expr, names());
}

/// The operators that the random trees below are made of.
struct Infix {
  ExprKind kind;
  std::string text;
  int level;
};
const std::array<Infix, 9> kInfix = {{{ExprKind::Or, "or", 1},
                                      {ExprKind::And, "and", 2},
                                      {ExprKind::Less, "<", 4},
                                      {ExprKind::Equal, "==", 4},
                                      {ExprKind::Add, "+", 5},
                                      {ExprKind::Sub, "-", 5},
                                      {ExprKind::Mul, "*", 6},
                                      {ExprKind::Div, "/", 6},
                                      {ExprKind::Pow, "^", 8}}};

ExprPtr random_tree(std::mt19937& random, int depth) {
  if (depth == 0) return local(random() % 4);
  switch (random() % 8) {
    case 0:
      return make(ExprKind::Neg, {random_tree(random, depth - 1)});
    case 1:
      return make(ExprKind::Not, {random_tree(random, depth - 1)});
    case 2:
      return make(ExprKind::If, {random_tree(random, depth - 1), random_tree(random, depth - 1),
                                 random_tree(random, depth - 1)});
    default: {
      const ExprKind kind = kInfix[random() % kInfix.size()].kind;
      return make(kind, {random_tree(random, depth - 1), random_tree(random, depth - 1)});
    }
  }
}

/// Every form in parentheses, so that no precedence is needed to read it.
std::string explicit_form(const Expr& expr) {
  const auto arg = [&](std::size_t i) { return explicit_form(*expr.args[i]); };
  if (expr.kind == ExprKind::Local) return names().slots[index(expr.slot)];
  if (expr.kind == ExprKind::Neg) return "(- " + arg(0) + ")";
  if (expr.kind == ExprKind::Not) return "(not " + arg(0) + ")";
  if (expr.kind == ExprKind::If) return "(if " + arg(0) + " " + arg(1) + " " + arg(2) + ")";
  for (const Infix& op : kInfix)
    if (op.kind == expr.kind) return "(" + arg(0) + " " + op.text + " " + arg(1) + ")";
  return "?";
}

/// Reads printed text with the precedences of the language and gives its explicit form.
class Reader {
 public:
  explicit Reader(std::string text) : text_(std::move(text)) {}
  std::string read() {
    std::string form = expression(0);
    return peek().empty() ? form : form + " then " + peek();
  }

 private:
  std::string peek() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    std::size_t end = at_;
    while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end]))) ++end;
    if (end == at_ && text_.compare(at_, 2, "==") == 0) return "==";
    return text_.substr(at_, std::max<std::size_t>(end - at_, 1));
  }
  std::string next() {
    std::string token = peek();
    at_ += token.size();
    return token;
  }
  std::string prefix(int least) {
    const std::string token = next();
    if (token == "(") {
      std::string inner = expression(0);
      next();
      return inner;
    }
    if (token == "-") return "(- " + expression(8) + ")";
    if (token == "not" && least <= 3) return "(not " + expression(3) + ")";
    if (token == "if" && least == 0) {
      std::string form = "(if " + expression(1);
      next();
      form += " " + expression(0);
      next();
      return form + " " + expression(0) + ")";
    }
    return token;
  }
  std::string expression(int least) {
    std::string left = prefix(least);
    int most = 9;  // comparisons do not chain: after one, only looser operators may follow
    for (;;) {
      const std::string token = peek();
      const auto op = std::find_if(kInfix.begin(), kInfix.end(),
                                   [&](const Infix& row) { return row.text == token; });
      if (op == kInfix.end() || op->level < least || op->level > most) return left;
      next();
      const bool right_associative = op->level == 8;
      left = "(" + left + " " + op->text + " " +
             expression(right_associative ? op->level : op->level + 1) + ")";
      if (op->level == 4) most = 3;
    }
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

TEST_CASE("printed expressions read back as the same tree") {
  const unsigned seed = 11;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  for (int trial = 0; trial < 3000; ++trial) {
    const ExprPtr tree = random_tree(random, 1 + trial % 4);
    const std::string text = shown(tree);
    INFO(text);
    REQUIRE(Reader(text).read() == explicit_form(*tree));
  }
}

TEST_CASE("parentheses stand only where precedence asks for them") {
  const ExprPtr a = local(0);
  const ExprPtr b = local(1);
  CHECK(shown(make(ExprKind::Sub, {a, make(ExprKind::Sub, {a, b})})) == "a - (a - b)");
  CHECK(shown(make(ExprKind::Sub, {make(ExprKind::Sub, {a, b}), a})) == "a - b - a");
  CHECK(shown(make(ExprKind::Neg, {make(ExprKind::Pow, {a, number(2)})})) == "-a^2");
  CHECK(shown(make(ExprKind::Pow, {make(ExprKind::Neg, {a}), number(2)})) == "(-a)^2");
  CHECK(shown(make(ExprKind::Pow, {number(-1), number(-2)})) == "(-1)^(-2)");
  CHECK(shown(make(ExprKind::Mul, {number(0.5), make(ExprKind::Add, {a, b})})) == "0.5 * (a + b)");
}

TEST_CASE("walks, values and folds print in the surface syntax") {
  const ExprPtr a = local(0);
  const ExprPtr x = local(2);
  CHECK(shown(position(alpha(alpha(a, 0), 1))) == "a@0@1.position");
  CHECK(shown(with(make(ExprKind::Free, {a}), &Expr::number, 2)) == "free(a, 2)");
  CHECK(shown(make(ExprKind::Has, {a})) == "has(a.position)");
  const ExprPtr corners = with(orbit(ExprKind::Quotient, {a}, {1, 2}), &Expr::orbit2, OrbitType{1});
  CHECK(shown(corners) == "<1,2>(a) / <1>");
  const ExprPtr mean =
      with(with(make(ExprKind::Fold, {corners, position(x)}), &Expr::slot, Slot{2}), &Expr::fold,
           FoldKind::Mean);
  CHECK(shown(mean) == "mean(x in <1,2>(a) / <1> : x.position)");
  const ExprPtr best =
      with(with(make(ExprKind::Fold, {make(ExprKind::Polygon, {a}), x, a}), &Expr::slot, Slot{2}),
           &Expr::fold, FoldKind::ArgMax);
  CHECK(shown(best) == "argmax(x in polygon(a) : x : a)");
  const ExprPtr count =
      with(with(make(ExprKind::Fold, {orbit(ExprKind::AllOrbits, {}, {0})}), &Expr::slot, Slot{2}),
           &Expr::fold, FoldKind::Count);
  CHECK(shown(count) == "count(x in all <0>)");
  CHECK(shown(make(ExprKind::Range, {number(0), make(ExprKind::Sub, {a, x})})) == "0..a - x");
  CHECK(shown(orbit(ExprKind::Random, {number(7), a}, {0, 1})) == "random(7, <0,1>(a))");
  CHECK(shown(orbit(ExprKind::ForceOn, {a}, {1})) == "force_on(<1>(a))");
  CHECK(shown(with(orbit(ExprKind::ForceOn, {a}, {1}), &Expr::number, 1)) ==
        "force_on(<1>(a), stretch_spring)");
  CHECK(shown(orbit(ExprKind::Forces, {a}, {1, 2})) == "forces(<1,2>(a))");
}

TEST_CASE("calls, components and the forms of derivatives print by name") {
  const ExprPtr d = local(3);
  const ExprPtr norm = with(make(ExprKind::Call, {d}), &Expr::builtin, Builtin::Norm);
  CHECK(shown(norm) == "norm(d)");
  CHECK(shown(with(make(ExprKind::Component, {d}), &Expr::number, 2)) == "d.z");
  const ExprPtr pair = with(local(3), &Expr::type, ValueType{ValueKind::EigenPair});
  CHECK(shown(with(make(ExprKind::Component, {pair}), &Expr::number, 1)) == "d.vector");
  CHECK(shown(make(ExprKind::Index, {d, number(1)})) == "d[1]");
  CHECK(shown(make(ExprKind::Tuple, {d, number(1), number(-2)})) == "(d, 1, -2)");
  CHECK(shown(make(ExprKind::Grad, {norm, position(local(0))})) == "grad(norm(d), a.position)");
  CHECK(shown(make(ExprKind::Frozen, {norm})) == "frozen(norm(d))");
  CHECK(shown(make(ExprKind::Convert, {make(ExprKind::Add, {d, d})})) == "d + d");
  CHECK(shown(make(ExprKind::Add, {number(1), make(ExprKind::Let, {norm, d})})) ==
        "1 + (let a = norm(d); d)");
  CHECK(shown(make(ExprKind::Time)) == "time");
}

TEST_CASE("names that are not known print by number") {
  CHECK(to_string(*position(local(9)), ExprNames{}) == "#9.#0");
}

TEST_CASE("shared subtrees cannot make the text grow without bound") {
  ExprPtr sum = local(0);
  for (int i = 0; i < 60; ++i) sum = make(ExprKind::Add, {sum, sum});
  const std::string text = shown(sum);
  CHECK(text.size() < 5000);
  CHECK(text.ends_with("…"));
}
