// SPDX-License-Identifier: MIT
// Where the numbers of an expression come from.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "compile/symbolic_walker.h"
#include "compile/value_parts.h"
#include "support/check.h"

namespace gmsim::compile {

using ir::Input;
using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::ValueKind;

namespace {

bool is_number(const types::ValueType& type) {
  if (type.is_array()) return false;
  return type.kind == ValueKind::Bool || type.kind == ValueKind::Int ||
         type.kind == ValueKind::Real || type.kind == ValueKind::Zero;
}

}  // namespace

SymbolicValue SymbolicWalker::constant(const types::ValueType& type,
                                       std::span<const double> numbers) {
  if (is_number(type)) return SymbolicValue::of(numbers.empty() ? 0.0 : numbers[0]);
  SymbolicValue value;
  if (graph_ == nullptr) return value;
  const ValueParts parts = value_parts(type);
  for (std::uint32_t k = 0; k < parts.count; ++k) {
    value.parts.push_back(constant_part(
        *graph_, parts.kind, numbers.subspan(std::size_t{k} * parts.stride, parts.stride)));
  }
  return value;
}

void SymbolicWalker::fail_missing(const Expr& reader, EmbeddingId id, DartId dart) {
  const gmap::EmbeddingDecl& decl = world_.schema[id];
  if (failed()) return;
  depend(decl.orbit, dart);
  fail(DiagnosticKind::MissingEmbeddingValue, reader.span,
       fmt::format("`{}` has no value at the {} orbit of dart {}", decl.name,
                   types::to_string(decl.orbit), types::index(dart)),
       decl.optional ? fmt::format("test with `has(a.{})` first", decl.name) : std::string());
  failure_->not_here = decl.optional;
}

SymbolicValue SymbolicWalker::read(const Expr& reader, EmbeddingId id, DartRef at) {
  if (failed()) return {};
  const bool gathered = sources_[id].kind == ValueSource::Kind::Gathered;
  if (!gathered && !carries_interaction(id, at)) {
    fail_missing(reader, id, at.dart);
    return {};
  }
  return read_source(reader, id, at);
}

/// A parameter that is the same everywhere has no column, but belongs to the orbits that carry its
/// interaction only. True for everything else.
bool SymbolicWalker::carries_interaction(EmbeddingId parameter, DartRef at) {
  const std::optional<EmbeddingId> mark = presences_[types::index(parameter)];
  if (!mark || !world_.store.in_use(*mark)) return true;
  const std::span<const double> value = world_.store.get(*mark, at.dart);
  depend(world_.schema[*mark].orbit, at.dart);
  trace_.spoil();
  return !value.empty() && value[0] != 0.0;
}

SymbolicValue SymbolicWalker::read_source(const Expr& reader, EmbeddingId id, DartRef at) {
  const ValueSource& source = sources_[id];
  switch (source.kind) {
    case ValueSource::Kind::Gathered:
      return read_column(reader, id, at);
    case ValueSource::Kind::Constant:
      return constant(world_.schema[id].type, source.constant);
    case ValueSource::Kind::Expression:
      return expand(source, at, world_.schema[id].orbit);
    case ValueSource::Kind::Missing:
      fail_missing(reader, id, at.dart);
      return {};
  }
  return {};
}

SymbolicValue SymbolicWalker::read_parameter(const BodyParameter& parameter, const Expr& reader) {
  const DartRef hook = cell(body_.dart).value.dart;
  if (parameter.embedding) return read_source(reader, *parameter.embedding, hook);
  const ValueSource* source = sources_.find_parameter(parameter.slot);
  GMSIM_CHECK(source != nullptr, fmt::format("parameter `{}` of `{}` has no source",
                                             parameter.name, body_.name));
  if (source->kind == ValueSource::Kind::Expression) return expand(*source, hook, body_.orbit);
  GMSIM_CHECK(source->kind == ValueSource::Kind::Constant,
              fmt::format("parameter `{}` of `{}` is no embedding", parameter.name, body_.name));
  return constant(parameter.type, source->constant);
}

SymbolicValue SymbolicWalker::read_column(const Expr& reader, EmbeddingId id, DartRef at) {
  const gmap::EmbeddingDecl& decl = world_.schema[id];
  if (world_.store.in_use(id)) {  // else a column of the engine's own, which is always full
    if (world_.store.get(id, at.dart).empty()) fail_missing(reader, id, at.dart);
    if (failed()) return {};
  }
  const std::uint32_t role = meet(decl.orbit, at);
  if (world_.store.in_use(id)) trace_.require(id, role);
  SymbolicValue value;
  if (graph_ == nullptr) return value;
  const ValueParts parts = value_parts(decl.type);
  for (std::uint32_t k = 0; k < parts.count; ++k) {
    const Input input{Input::Source::Embedding, id, role, k * parts.stride};
    value.parts.push_back(graph_->input(input, parts.kind, reader.span));
  }
  if (id == world_.position) {
    positions_.resize(std::max<std::size_t>(positions_.size(), role + std::size_t{1}), ir::kNone);
    positions_[role] = value.parts[0];
  }
  const bool is_mask = decl.type.kind == ValueKind::Bool && !decl.type.is_array();
  return is_mask ? mask(reader, value.parts[0]) : value;
}

SymbolicValue SymbolicWalker::expand(const ValueSource& source, DartRef at, OrbitType orbit) {
  Frame* outer = frame_;
  if (source.frame == ValueSource::Frame::Item) {
    frame_ = &item_frame_;
  } else {
    while (inner_frames_.size() <= depth_) inner_frames_.emplace_back();
    Frame& inner = inner_frames_[depth_];
    inner.assign(source.frame_size, {});
    frame_ = &inner;
    const bool move = source.frame == ValueSource::Frame::SmallestDart && !orbit.empty();
    if (move) {  // so that the last bit does not depend on which dart asks
      at = {walked_.smallest(orbit, at.dart), kNoWalk};
      trace_.spoil();
    }
    bind(source.dart, at);
  }
  ++depth_;
  SymbolicValue value = evaluate(*source.expr);
  --depth_;
  frame_ = outer;
  return value;
}

SymbolicValue SymbolicWalker::has(const Expr& expr) {
  const DartRef at = dart(*expr.args[0]);
  if (failed()) return SymbolicValue::of(0.0);
  const ValueSource& source = sources_[expr.embedding];
  const bool mark = world_.schema[expr.embedding].role == gmap::EmbeddingRole::Presence;
  const auto outcome = [&](bool present) {
    decide(present ? 1 : 0);
    return SymbolicValue::of(present ? 1.0 : 0.0);
  };
  switch (source.kind) {
    case ValueSource::Kind::Constant:
    case ValueSource::Kind::Expression:
      if (mark && source.kind == ValueSource::Kind::Constant)
        return outcome(source.constant.at(0) != 0.0);
      return outcome(carries_interaction(expr.embedding, at));
    case ValueSource::Kind::Missing:
      return SymbolicValue::of(0.0);
    case ValueSource::Kind::Gathered:
      break;
  }
  if (!world_.store.in_use(expr.embedding)) return SymbolicValue::of(1.0);
  const std::span<const double> value = world_.store.get(expr.embedding, at.dart);
  depend(world_.schema[expr.embedding].orbit, at.dart);
  trace_.spoil();
  return outcome(!value.empty() && (!mark || value[0] != 0.0));
}

SymbolicValue SymbolicWalker::random(const Expr& expr) {
  const SymbolicValue seed = evaluate(*expr.args[0]);
  const DartRef at = dart(*expr.args[1]);
  if (failed()) return {};
  if (!seed.known) {
    fail(DiagnosticKind::NotConstant, expr.args[0]->span,
         "the seed of `random` depends on numbers that may change at every step");
    return {};
  }
  const Draw draw{static_cast<std::int64_t>(seed.number), meet(expr.orbit, at)};
  const auto known = std::find(draws_.begin(), draws_.end(), draw);
  const auto number = static_cast<std::uint32_t>(known - draws_.begin());
  if (known == draws_.end()) draws_.push_back(draw);
  if (graph_ == nullptr) return {};
  const Input input{.source = Input::Source::MatchValue, .role = number};
  return of_parts({graph_->input(input, ValueKind::Real, expr.span)});
}

SymbolicValue SymbolicWalker::clock(const Expr& expr) {
  if (graph_ == nullptr) return {};
  const Input::Source source = expr.kind == ExprKind::Time   ? Input::Source::Time
                               : expr.kind == ExprKind::Step ? Input::Source::Step
                                                             : Input::Source::Dt;
  return of_parts({graph_->input({.source = source}, ValueKind::Real, expr.span)});
}

SymbolicValue SymbolicWalker::grad(const Expr& expr) {
  const SymbolicValue energy = evaluate(*expr.args[0]);
  const SymbolicValue variable = evaluate(*expr.args[1]);
  if (failed()) return {};
  if (variable.known) return SymbolicValue::of(0.0);
  if (graph_ == nullptr) return {};
  const NodeId y = node(energy, expr.args[0]->type);
  for (const NodeId x : variable.parts) {
    if ((*graph_)[x].op == Op::Input) continue;
    fail(DiagnosticKind::NotDifferentiable, expr.args[1]->span,
         "`grad` needs a value that is stored, this one is computed from others or the same "
         "everywhere",
         "differentiate with respect to what it is computed from");
    return {};
  }
  SymbolicValue value;
  value.parts = ir::gradient(*graph_, y, variable.parts);
  differentiated_.push_back(y);
  return value;
}

}  // namespace gmsim::compile
