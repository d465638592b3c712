// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include "compile/ir_simplifier.h"

namespace gmsim::compile::ir {
namespace {

constexpr std::array<int, 6> kSymRows = {0, 1, 2, 1, 0, 0};  // xx yy zz yz xz xy
constexpr std::array<int, 6> kSymColumns = {0, 1, 2, 2, 2, 1};
constexpr std::array<std::uint32_t, 9> kSymOfFull = {0, 5, 4, 5, 1, 3, 4, 3, 2};

}  // namespace

/// Which axis a constant vector is, if it is one.
std::optional<std::uint32_t> Simplifier::axis(NodeId id) const {
  if (!is(id, Op::Vector)) return std::nullopt;
  std::optional<std::uint32_t> which;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const NodeId entry = inner(id, static_cast<int>(k));
    if (graph_.is_zero(entry)) continue;
    if (!equals(entry, 1) || which) return std::nullopt;
    which = k;
  }
  return which;
}

std::optional<NodeId> Simplifier::vector() {
  if (graph_.is_zero(a_) && graph_.is_zero(b_) && graph_.is_zero(c_)) return zero(ValueKind::Vec3);
  // The three entries of one vector are that vector.
  const std::array<NodeId, 3> entries = {a_, b_, c_};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Node& entry = node(entries[k]);
    const bool same = entry.op == Op::Component && entry.aux == k &&
                      entry.operands[0] == node(a_).operands[0];
    if (!same || node(entry.operands[0]).type != ValueKind::Vec3) return std::nullopt;
  }
  return inner(a_);
}

std::optional<NodeId> Simplifier::component() {
  if (graph_.is_zero(a_)) return zero(ValueKind::Real);
  const bool symmetric = node(a_).type == ValueKind::Sym3;
  switch (node(a_).op) {
    case Op::Vector: return inner(a_, static_cast<int>(aux_));
    case Op::Neg: return negated(make(op_, inner(a_), kNone, kNone, aux_));
    case Op::Columns: return make(op_, inner(a_, static_cast<int>(aux_ % 3)), kNone, kNone, aux_ / 3);
    case Op::Full: return make(op_, inner(a_), kNone, kNone, kSymOfFull[aux_]);
    case Op::Diagonal:
      if (!symmetric || kSymRows[aux_] != kSymColumns[aux_]) return zero(ValueKind::Real);
      return make(op_, inner(a_), kNone, kNone, aux_);
    default: return std::nullopt;
  }
}

std::optional<NodeId> Simplifier::dot() {
  if (const auto k = axis(b_)) return make(Op::Component, a_, kNone, kNone, *k);
  if (const auto k = axis(a_)) return make(Op::Component, b_, kNone, kNone, *k);
  return product(ValueKind::Real);
}

std::optional<NodeId> Simplifier::cross() {
  if (a_ == b_) return zero(ValueKind::Vec3);
  if (const auto simpler = product(ValueKind::Vec3)) return simpler;
  if (swapped_difference(a_)) return negated(make(op_, negated(a_), b_));
  if (swapped_difference(b_)) return negated(make(op_, a_, negated(b_)));
  if (index(a_) > index(b_)) return negated(plain(b_, a_));
  return std::nullopt;
}

std::optional<NodeId> Simplifier::matvec() {
  if (is(a_, Op::Full)) return make(op_, inner(a_), b_);
  if (is(a_, Op::Columns))
    if (const auto k = axis(b_)) return inner(a_, static_cast<int>(*k));
  return product(ValueKind::Vec3);
}

/// x - y with x made after y: y - x is used instead, so both ways share one node.
bool Simplifier::swapped_difference(NodeId id) const {
  return is(id, Op::Sub) && index(inner(id, 0)) > index(inner(id, 1));
}

std::optional<NodeId> Simplifier::norm() {
  if (graph_.is_zero(a_)) return zero(ValueKind::Real);
  if (is(a_, Op::Neg)) return make(op_, inner(a_));
  if (swapped_difference(a_)) return make(op_, negated(a_));
  return std::nullopt;
}

std::optional<NodeId> Simplifier::normalize() {
  if (graph_.is_zero(a_)) return a_;
  if (is(a_, Op::Neg)) return negated(make(op_, inner(a_)));
  if (swapped_difference(a_)) return negated(make(op_, negated(a_)));
  if (is(a_, Op::Scale) && number(inner(a_)) && power_of_two(value(inner(a_))))
    return make(op_, inner(a_, 1));
  return std::nullopt;
}

/// Transposing, taking parts and the trace: linear, so minus signs pass.
std::optional<NodeId> Simplifier::linear() {
  if (graph_.is_zero(a_)) {
    if (op_ == Op::Trace) return zero(ValueKind::Real);
    return zero(op_ == Op::Transpose || op_ == Op::Full ? ValueKind::Mat3 : ValueKind::Sym3);
  }
  if (is(a_, Op::Neg)) return negated(make(op_, inner(a_)));
  const Op inside = node(a_).op;
  switch (op_) {
    case Op::Transpose:
      if (inside == Op::Transpose) return inner(a_);
      if (inside == Op::Full) return a_;
      if (inside == Op::Outer) return make(Op::Outer, inner(a_, 1), inner(a_, 0));
      return std::nullopt;
    case Op::Sym:
      if (inside == Op::Full) return inner(a_);
      if (inside == Op::Transpose) return make(op_, inner(a_));
      return std::nullopt;
    case Op::Trace:
      if (inside == Op::Full || inside == Op::Sym || inside == Op::Transpose)
        return make(op_, inner(a_));
      return std::nullopt;
    default: return std::nullopt;
  }
}

}  // namespace gmsim::compile::ir
