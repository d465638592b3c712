// SPDX-License-Identifier: MIT
#include <cmath>

#include "compile/ir_simplifier.h"

namespace gmsim::compile::ir {

/// Multiplying by it changes no digit; small enough to stay in range.
bool Simplifier::power_of_two(double x) {
  int exponent = 0;
  return std::frexp(x, &exponent) == 0.5 && std::abs(exponent) < 64;
}

/// x is `if m then y else 0` or `if m then 0 else y`.
bool Simplifier::guards(NodeId id) const {
  return is(id, Op::Select) && (graph_.is_zero(inner(id, 1)) || graph_.is_zero(inner(id, 2)));
}

/// A product with a guarded factor is guarded.
std::optional<NodeId> Simplifier::branch_outwards() {
  const bool first = guards(a_);
  if (!first && (op_ == Op::Div || !guards(b_))) return std::nullopt;
  const NodeId guarded = first ? a_ : b_;
  const NodeId mask = inner(guarded);
  const bool in_then = graph_.is_zero(inner(guarded, 2));
  const int arm = in_then ? 1 : 2;
  // A second factor under the same guard needs it no more.
  const auto stripped = [&](NodeId id) {
    const bool same = guards(id) && inner(id) == mask && graph_.is_zero(inner(id, 3 - arm));
    return same ? inner(id, arm) : id;
  };
  const NodeId value = make(op_, stripped(a_), stripped(b_));
  const NodeId none = zero(node(value).type);
  return in_then ? make(Op::Select, mask, value, none) : make(Op::Select, mask, none, value);
}

/// (-a) op b = a op (-b) = -(a op b) for products and quotients; negative constants likewise.
std::optional<NodeId> Simplifier::minus_outwards() {
  const auto negative = [&](NodeId id) {
    return is(id, Op::Neg) || (number(id) && value(id) < 0);
  };
  if (negative(a_)) return negated(make(op_, negated(a_), b_));
  if (negative(b_)) return negated(make(op_, a_, negated(b_)));
  return std::nullopt;
}

/// (p x) op b = p (x op b), likewise for b, when p is a power of two.
std::optional<NodeId> Simplifier::power_of_two_outwards() {
  const auto factor = [&](NodeId id) {
    const bool multiple = is(id, Op::Mul) && number(inner(id)) && power_of_two(value(inner(id)));
    return multiple ? value(inner(id)) : 1.0;
  };
  if (const double p = factor(a_); p != 1) return times(p, make(op_, inner(a_, 1), b_));
  if (const double p = factor(b_); p != 1)
    return times(op_ == Op::Div ? 1 / p : p, make(op_, a_, inner(b_, 1)));
  return std::nullopt;
}

std::optional<NodeId> Simplifier::mul() {
  if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(ValueKind::Real);
  if (number(a_) && number(b_)) return graph_.constant(value(a_) * value(b_));
  if (number(b_)) return make(Op::Mul, b_, a_);  // constants first
  if (equals(a_, 1)) return b_;
  if (const auto outside = minus_outwards()) return outside;
  if (is(a_, Op::AsReal)) return make(Op::Select, inner(a_), b_, zero(ValueKind::Real));
  if (is(b_, Op::AsReal)) return make(Op::Select, inner(b_), a_, zero(ValueKind::Real));
  if (const auto outside = branch_outwards()) return outside;
  if (number(a_)) {
    const bool multiple = is(b_, Op::Mul) && number(inner(b_));
    if (multiple && (power_of_two(value(a_)) || power_of_two(value(inner(b_)))))
      return times(value(a_) * value(inner(b_)), inner(b_, 1));
    return std::nullopt;
  }
  if (const auto outside = power_of_two_outwards()) return outside;
  return ordered();
}

/// A number, vector or matrix over a number.
std::optional<NodeId> Simplifier::div() {
  if (graph_.is_zero(a_) && !graph_.is_zero(b_)) return a_;
  if (number(a_) && number(b_) && value(b_) != 0) return graph_.constant(value(a_) / value(b_));
  if (equals(b_, 1)) return a_;
  if (const auto outside = minus_outwards()) return outside;
  if (number(b_) && power_of_two(value(b_))) return times(1 / value(b_), a_);
  if (const auto outside = branch_outwards()) return outside;
  return power_of_two_outwards();
}

std::optional<NodeId> Simplifier::scale() {
  if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(node(b_).type);
  if (equals(a_, 1)) return b_;
  if (const auto outside = minus_outwards()) return outside;
  if (is(a_, Op::AsReal)) return make(Op::Select, inner(a_), b_, zero(node(b_).type));
  if (number(a_) && power_of_two(value(a_)) && is(b_, Op::Scale))
    return make(op_, times(value(a_), inner(b_)), inner(b_, 1));
  return branch_outwards();
}

/// Products of vectors and matrices other than by numbers.
std::optional<NodeId> Simplifier::product(ValueKind type) {
  if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(type);
  if (const auto outside = minus_outwards()) return outside;
  if (const auto outside = branch_outwards()) return outside;
  return op_ == Op::Dot || op_ == Op::Contract ? ordered() : std::nullopt;
}

}  // namespace gmsim::compile::ir
