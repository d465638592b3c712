// SPDX-License-Identifier: MIT
// The arithmetic of NormalForms: sums of products of atoms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/normal_form.h"

namespace gmsim::check {

using types::Builtin;
using types::ExprKind;
using types::ValueKind;

namespace {

/// A product of sums longer than this stays a product of two atoms.
constexpr std::size_t kMostTerms = 256;

std::optional<double> constant(const Sum& sum) {
  if (sum.empty()) return 0.0;
  if (sum.size() > 1 || sum.begin()->first != Product{}) return std::nullopt;
  return sum.begin()->second;
}

Sum scaled(Sum sum, double factor) {
  for (auto& term : sum) term.second *= factor;
  return sum;
}

/// The sign of the first term: of a sum and its negative, one has +1.
double sign_of(const Sum& sum) {
  return !sum.empty() && sum.begin()->second < 0 ? -1.0 : 1.0;
}

std::vector<int> merged(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> both;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

void add(Sum& sum, Product product, double factor) {
  const auto found = sum.emplace(std::move(product), 0.0).first;
  const double before = found->second;
  found->second += factor;
  // What rounding leaves of x - x is nothing.
  if (std::abs(found->second) <= 1e-12 * std::abs(before)) sum.erase(found);
}

std::string text(const std::vector<int>& atoms) {
  return fmt::format("{}", fmt::join(atoms, ","));
}

}  // namespace

Sum plus(Sum a, const Sum& b, double factor) {
  for (const auto& [product, x] : b) add(a, product, factor * x);
  return a;
}

int NormalForms::id(const Sum& sum) {
  std::string key = "sum";
  for (const auto& [product, factor] : sum)
    key += fmt::format(" {:.12g}*{};{}", factor, text(product.scalars), text(product.others));
  return intern(key);
}

Sum NormalForms::multiply(const Sum& a, const Sum& b) {
  if (a.size() * b.size() > kMostTerms) {
    // Atoms in place of the sums; their kinds are kept so that the order of matrices is.
    const auto whole = [&](const Sum& sum) {
      const bool scalar = sum.begin()->first.others.empty();
      return scaled(atom(fmt::format("whole {}", id(scaled(sum, sign_of(sum)))), scalar),
                    sign_of(sum));
    };
    return multiply(whole(a), whole(b));
  }
  Sum result;
  for (const auto& [p, x] : a)
    for (const auto& [q, y] : b) {
      Product product{merged(p.scalars, q.scalars), p.others};
      product.others.insert(product.others.end(), q.others.begin(), q.others.end());
      add(result, std::move(product), x * y);
    }
  return result;
}

Sum NormalForms::quotient(const Sum& a, const Sum& b) {
  if (const std::optional<double> divisor = constant(b); divisor && *divisor != 0)
    return scaled(a, 1.0 / *divisor);
  if (b.size() == 1) {
    Sum inverse{{Product{}, 1.0 / b.begin()->second}};
    for (const int factor : b.begin()->first.scalars)
      inverse = multiply(inverse, atom(fmt::format("1/{}", factor), true));
    if (b.begin()->first.others.empty()) return multiply(a, inverse);
  }
  return multiply(a, with_parity("1/", -1, true, b));
}

Sum NormalForms::power(const types::Expr& expr) {
  const Sum base = number(*expr.args.at(0)), exponent = number(*expr.args.at(1));
  const std::optional<double> e = constant(exponent);
  if (e && *e == 1) return base;
  if (e && *e == 2 && base.size() * base.size() <= kMostTerms) return multiply(base, base);
  const bool whole = e && *e == std::floor(*e);
  const int sign = !whole ? 0 : std::fmod(*e, 2.0) == 0 ? 1 : -1;
  return with_parity(fmt::format("power {} ", id(exponent)), sign, true, base);
}

Sum NormalForms::with_parity(const std::string& name, int sign, bool scalar, const Sum& argument) {
  const double turned = sign == 0 ? 1.0 : sign_of(argument);
  const Sum result = atom(name + std::to_string(id(scaled(argument, turned))), scalar);
  return sign < 0 ? scaled(result, turned) : result;
}

Sum NormalForms::bilinear(const std::string& name, int flip, bool scalar, const Sum& a,
                          const Sum& b) {
  if (a.size() * b.size() > kMostTerms)
    return atom(fmt::format("{} {} {}", name, id(a), id(b)), scalar);
  Sum result;
  for (const auto& [p, x] : a)
    for (const auto& [q, y] : b) {
      const bool turn = flip != 0 && q.others < p.others;
      if (flip < 0 && p.others == q.others) continue;
      const std::vector<int>&first = turn ? q.others : p.others,
            &second = turn ? p.others : q.others;
      const int factor = intern(fmt::format("{} {};{}", name, text(first), text(second)));
      Product product{merged(p.scalars, q.scalars), {}};
      if (scalar) {
        product.scalars = merged(product.scalars, {factor});
      } else {
        product.others = {factor};
      }
      add(result, std::move(product), x * y * (turn ? flip : 1));
    }
  return result;
}

Sum NormalForms::symmetric(const std::string& name, const std::vector<const types::Expr*>& operands,
                           bool scalar) {
  std::vector<int> ids;
  for (const types::Expr* operand : operands) {
    const Form form = evaluate(*operand);
    const Sum& sum = form.sum;
    // min(min(a, b), c) and min(a, min(b, c)) hold the same three.
    const bool single = form.kind == Form::Kind::Number && sum.size() == 1 &&
                        sum.begin()->second == 1.0 && sum.begin()->first.scalars.size() == 1 &&
                        sum.begin()->first.others.empty();
    const auto nested = single ? operands_.find(sum.begin()->first.scalars[0]) : operands_.end();
    if (nested != operands_.end() && nested->second.front() == intern(name)) {
      ids.insert(ids.end(), nested->second.begin() + 1, nested->second.end());
    } else {
      ids.push_back(id(form));
    }
  }
  std::sort(ids.begin(), ids.end());
  const std::string key = fmt::format("{} {}", name, text(ids));
  ids.insert(ids.begin(), intern(name));
  operands_[intern(key)] = std::move(ids);
  return atom(key, scalar);
}

Sum NormalForms::comparison(const types::Expr& expr) {
  const Sum a = number(*expr.args.at(0)), b = number(*expr.args.at(1));
  const Sum difference = plus(a, b, -1.0);
  switch (expr.kind) {
    case ExprKind::Greater:
      return atom(fmt::format("positive {}", id(difference)), true);
    case ExprKind::Less:
      return atom(fmt::format("positive {}", id(scaled(difference, -1.0))), true);
    case ExprKind::GreaterEqual:
      return atom(fmt::format("not negative {}", id(difference)), true);
    case ExprKind::LessEqual:
      return atom(fmt::format("not negative {}", id(scaled(difference, -1.0))), true);
    case ExprKind::Equal:
      return with_parity("zero ", 1, true, difference);
    default:
      return with_parity("not zero ", 1, true, difference);
  }
}

/// Components are linear: (2 s v).x is 2 s times v.x.
Sum NormalForms::component(const types::Expr& expr) {
  const types::Expr& whole = *expr.args.at(0);
  const Sum of = number(whole);
  const bool linear = whole.type.kind != ValueKind::EigenPair;
  if (!linear) return atom(fmt::format("part {} {}", expr.number, id(of)), expr);
  Sum result;
  for (const auto& [product, factor] : of) {
    const int part = intern(fmt::format("component {} {}", expr.number, text(product.others)));
    add(result, Product{merged(product.scalars, {part}), {}}, factor);
  }
  return result;
}

Sum NormalForms::call(const types::Expr& expr) {
  const auto arg = [&](std::size_t k) { return number(*expr.args.at(k)); };
  const bool scalar = expr.type.kind == ValueKind::Real || expr.type.kind == ValueKind::Int;
  const std::string name(types::info(expr.builtin).name);
  switch (expr.builtin) {
    case Builtin::Dot:
    case Builtin::Contract:
      return bilinear(name, 1, true, arg(0), arg(1));
    case Builtin::Cross:
      return bilinear(name, -1, false, arg(0), arg(1));
    case Builtin::Outer:
      return bilinear(name, 0, false, arg(0), arg(1));
    case Builtin::Norm:
    case Builtin::Abs:
    case Builtin::Cos:
      return with_parity(name + " ", 1, scalar, arg(0));
    case Builtin::Normalize:
    case Builtin::Sign:
    case Builtin::Sin:
    case Builtin::Tan:
    case Builtin::Asin:
    case Builtin::Atan:
    case Builtin::Tanh:
    case Builtin::Inverse:
    case Builtin::Transpose:
    case Builtin::Trace:
    case Builtin::Sym:
    case Builtin::Mat:
    case Builtin::Diagonal:
      return with_parity(name + " ", -1, scalar, arg(0));
    case Builtin::Atan2:
      return with_parity(fmt::format("atan2 {} ", id(arg(1))), -1, true, arg(0));
    case Builtin::Min:
    case Builtin::Max:
      return symmetric(name, {expr.args.at(0).get(), expr.args.at(1).get()}, true);
    default: {
      std::string key = fmt::format("{} {}", name, expr.number);
      for (const types::ExprPtr& argument : expr.args)
        key += fmt::format(" {}", id(number(*argument)));
      return atom(key, scalar);
    }
  }
}

}  // namespace gmsim::check
