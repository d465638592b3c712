// SPDX-License-Identifier: MIT
// The builtin functions as operations of the graph.
#include <algorithm>
#include <cmath>
#include <vector>

#include "compile/symbolic_walker.h"
#include "compile/value_parts.h"

namespace gmsim::compile {

using types::Builtin;
using types::Expr;
using types::ValueKind;

namespace {

/// Builtins that are one operation on all their overloads but those of two dimensions.
std::optional<ir::Op> single_op(Builtin builtin) {
  using ir::Op;
  switch (builtin) {
    case Builtin::Norm: return Op::Norm;
    case Builtin::Normalize: return Op::Normalize;
    case Builtin::Dot: return Op::Dot;
    case Builtin::Cross: return Op::Cross;
    case Builtin::Outer: return Op::Outer;
    case Builtin::Abs: return Op::Abs;
    case Builtin::Sign: return Op::Sign;
    case Builtin::Min: return Op::Min;
    case Builtin::Max: return Op::Max;
    case Builtin::Floor: return Op::Floor;
    case Builtin::Ceil: return Op::Ceil;
    case Builtin::Mod: return Op::Mod;
    case Builtin::Sqrt: return Op::Sqrt;
    case Builtin::Exp: return Op::Exp;
    case Builtin::Log: return Op::Log;
    case Builtin::Sin: return Op::Sin;
    case Builtin::Cos: return Op::Cos;
    case Builtin::Tan: return Op::Tan;
    case Builtin::Asin: return Op::Asin;
    case Builtin::Acos: return Op::Acos;
    case Builtin::Atan: return Op::Atan;
    case Builtin::Atan2: return Op::Atan2;
    case Builtin::Tanh: return Op::Tanh;
    case Builtin::Det: return Op::Det;
    case Builtin::Inverse: return Op::Inverse;
    case Builtin::Transpose: return Op::Transpose;
    case Builtin::Trace: return Op::Trace;
    case Builtin::Sym: return Op::Sym;
    case Builtin::Mat: return Op::Full;
    case Builtin::Columns3: return Op::Columns;
    case Builtin::Diagonal: return Op::Diagonal;
    case Builtin::Contract: return Op::Contract;
    case Builtin::PolarRotation: return Op::Polar;
    case Builtin::Clamp:
    case Builtin::Rows3:
    case Builtin::Identity3:
    case Builtin::Identity2:
    case Builtin::MaxEigenpair:
    case Builtin::MinEigenpair:
    case Builtin::Real:
      return std::nullopt;
  }
  return std::nullopt;
}

double modulo(double x, double divisor) {
  const double rest = std::fmod(x, divisor);
  return rest != 0.0 && (rest < 0.0) != (divisor < 0.0) ? rest + divisor : rest;
}

}  // namespace

/// Results that every machine rounds alike; the others are left to the engine's own code.
std::optional<double> SymbolicWalker::known_call(const Expr& expr,
                                                 std::span<const SymbolicValue> arguments) const {
  const bool known = !arguments.empty() && std::all_of(arguments.begin(), arguments.end(),
                                                       [](const auto& a) { return a.known; });
  if (!known) return std::nullopt;
  const double x = arguments[0].number;
  const double y = arguments.size() > 1 ? arguments[1].number : 0.0;
  switch (expr.builtin) {
    case Builtin::Real: return x;
    case Builtin::Norm:
    case Builtin::Abs: return std::abs(x);
    case Builtin::Sign: return static_cast<double>(x > 0.0) - static_cast<double>(x < 0.0);
    case Builtin::Min: return y < x ? y : x;
    case Builtin::Max: return x < y ? y : x;
    case Builtin::Clamp: return x < y ? y : x > arguments[2].number ? arguments[2].number : x;
    case Builtin::Floor: return std::floor(x);
    case Builtin::Ceil: return std::ceil(x);
    case Builtin::Mod: return modulo(x, y);
    case Builtin::Sqrt: return std::sqrt(x);
    default: return std::nullopt;
  }
}

SymbolicValue SymbolicWalker::call(const Expr& expr) {
  std::vector<SymbolicValue> arguments;
  arguments.reserve(expr.args.size());
  const types::Signature& signature =
      types::info(expr.builtin).signatures[static_cast<std::size_t>(expr.number)];
  for (std::size_t i = 0; i < expr.args.size(); ++i)
    arguments.push_back(operand(*expr.args[i], signature.parameters[i]));
  if (const auto known = known_call(expr, arguments)) return SymbolicValue::of(*known);
  if (graph_ == nullptr || failed()) return {};
  const auto first = [&](std::size_t i) { return part(arguments[i], 0); };
  switch (expr.builtin) {
    case Builtin::Clamp:
      return clamp(expr, arguments);
    case Builtin::Identity3: {
      const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
      return constant(expr.type, identity);
    }
    case Builtin::Identity2: {
      const double identity[4] = {1, 0, 0, 1};
      return constant(expr.type, identity);
    }
    case Builtin::MaxEigenpair:
      return of_parts({make(expr, Op::MaxEigenvalue, first(0)),
                       make(expr, Op::MaxEigenvector, first(0))});
    case Builtin::MinEigenpair:
      return of_parts({make(expr, Op::MinEigenvalue, first(0)),
                       make(expr, Op::MinEigenvector, first(0))});
    case Builtin::Real:
      if (signature.parameters[0].kind == ValueKind::Bool)
        return of_parts({make(expr, Op::AsReal, first(0))});
      return arguments[0];
    case Builtin::Rows3:
      if (signature.result.kind == ValueKind::Mat2) break;
      return of_parts(
          {make(expr, Op::Transpose, make(expr, Op::Columns, first(0), first(1), first(2)))});
    default:
      break;
  }
  const ValueKind kind = signature.parameters[0].kind;
  if (kind == ValueKind::Vec2 || kind == ValueKind::Mat2) return call2(expr, arguments);
  if (expr.builtin == Builtin::Norm && kind == ValueKind::Real)
    return of_parts({make(expr, Op::Abs, first(0))});
  const std::size_t count = arguments.size();
  return of_parts({make(expr, *single_op(expr.builtin), first(0), count > 1 ? first(1) : ir::kNone,
                        count > 2 ? first(2) : ir::kNone)});
}

SymbolicValue SymbolicWalker::clamp(const Expr& expr, std::span<const SymbolicValue> arguments) {
  const NodeId x = part(arguments[0], 0), lo = part(arguments[1], 0), hi = part(arguments[2], 0);
  const bool ordered =
      arguments[1].known && arguments[2].known && arguments[1].number <= arguments[2].number;
  if (ordered) return of_parts({make(expr, Op::Min, make(expr, Op::Max, x, lo), hi)});
  const NodeId below_top = make(expr, Op::Select, make(expr, Op::Less, hi, x), hi, x);
  return of_parts({make(expr, Op::Select, make(expr, Op::Less, x, lo), lo, below_top)});
}

/// Overloads on vec2 and mat2, by components.
SymbolicValue SymbolicWalker::call2(const Expr& expr, std::span<const SymbolicValue> arguments) {
  const auto in = [&](std::size_t which, std::size_t i) { return part(arguments[which], i); };
  const auto times = [&](NodeId a, NodeId b) { return make(expr, Op::Mul, a, b); };
  const auto plus = [&](NodeId a, NodeId b) { return make(expr, Op::Add, a, b); };
  const auto minus = [&](NodeId a, NodeId b) { return make(expr, Op::Sub, a, b); };
  const auto in_space = [&] { return make(expr, Op::Vector, in(0, 0), in(0, 1), number(0.0)); };
  const auto determinant = [&] { return minus(times(in(0, 0), in(0, 3)), times(in(0, 1), in(0, 2))); };
  switch (expr.builtin) {
    case Builtin::Norm:  // in space, where length and direction have their derivatives
      return of_parts({make(expr, Op::Norm, in_space())});
    case Builtin::Normalize: {
      const NodeId unit = make(expr, Op::Normalize, in_space());
      return of_parts({make(expr, Op::Component, unit, ir::kNone, ir::kNone, 0),
                       make(expr, Op::Component, unit, ir::kNone, ir::kNone, 1)});
    }
    case Builtin::Dot:
      return of_parts({plus(times(in(0, 0), in(1, 0)), times(in(0, 1), in(1, 1)))});
    case Builtin::Det:
      return of_parts({determinant()});
    case Builtin::Inverse: {
      const NodeId det = determinant();
      const auto over = [&](NodeId x) { return make(expr, Op::Div, x, det); };
      return of_parts({over(in(0, 3)), over(make(expr, Op::Neg, in(0, 1))),
                       over(make(expr, Op::Neg, in(0, 2))), over(in(0, 0))});
    }
    case Builtin::Transpose:
      return of_parts({in(0, 0), in(0, 2), in(0, 1), in(0, 3)});
    case Builtin::Trace:
      return of_parts({plus(in(0, 0), in(0, 3))});
    case Builtin::Rows3:
      return of_parts({in(0, 0), in(0, 1), in(1, 0), in(1, 1)});
    case Builtin::Contract: {
      NodeId sum = times(in(0, 0), in(1, 0));
      for (std::size_t i = 1; i < 4; ++i) sum = plus(sum, times(in(0, i), in(1, i)));
      return of_parts({sum});
    }
    case Builtin::PolarRotation:
      return polar2(expr, arguments[0]);
    default:
      support::internal_error(__FILE__, __LINE__, "no overload of two dimensions");
  }
}

/// The angle of the closest rotation has cosine and sine proportional to the trace and to the
/// antisymmetric part; a multiple of a reflection has no closest one: the identity.
SymbolicValue SymbolicWalker::polar2(const Expr& expr, const SymbolicValue& f) {
  const NodeId c = make(expr, Op::Add, part(f, 0), part(f, 3));
  const NodeId s = make(expr, Op::Sub, part(f, 2), part(f, 1));
  const NodeId direction = make(expr, Op::Vector, c, s, number(0.0));
  const NodeId unit = make(expr, Op::Normalize, direction);
  const NodeId some = make(expr, Op::Less, number(0.0), make(expr, Op::Norm, direction));
  const NodeId cosine =
      make(expr, Op::Select, some, make(expr, Op::Component, unit, ir::kNone, ir::kNone, 0),
           number(1.0));
  const NodeId sine = make(expr, Op::Component, unit, ir::kNone, ir::kNone, 1);
  return of_parts({cosine, make(expr, Op::Neg, sine), sine, cosine});
}

}  // namespace gmsim::compile
