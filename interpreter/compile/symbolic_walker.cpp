// SPDX-License-Identifier: MIT
#include "compile/symbolic_walker.h"

#include <fmt/format.h>

#include <utility>

#include "compile/value_parts.h"
#include "support/check.h"

namespace gmsim::compile {

using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::ValueKind;

SymbolicWalker::SymbolicWalker(const World& world, const ItemBody& body,
                               const ValueSources& sources)
    : world_(world), body_(body), sources_(sources), roles_(world), walked_(world.map) {
  for (const gmap::EmbeddingDecl& decl : world.schema) {
    const bool parameter = decl.role == gmap::EmbeddingRole::Parameter;
    presences_.push_back(parameter ? world.schema.find(decl.name.substr(0, decl.name.find('.')))
                                   : std::nullopt);
  }
}

void SymbolicWalker::start(std::span<const DartId> nodes, ir::Graph* graph) {
  GMSIM_CHECK(nodes.size() == body_.nodes.size(), "one dart for each node of the pattern");
  graph_ = graph;
  roles_.clear();
  trace_.start(static_cast<std::uint32_t>(nodes.size()), record_walks_);
  key_.clear();
  draws_.clear();
  atomic_.clear();
  walked_.start(nodes);
  everywhere_ = false;
  positions_.clear();
  differentiated_.clear();
  failure_.reset();
  depth_ = 0;
  frame_ = &item_frame_;
  item_frame_.assign(body_.frame_size, {});
  for (std::uint32_t i = 0; i < nodes.size(); ++i) bind(body_.nodes[i], DartRef{nodes[i], i});
  bind(body_.dart, DartRef{nodes[body_.hook], body_.hook});
  for (const BodyParameter& parameter : body_.parameters) {
    Cell& pending = cell(parameter.slot);
    pending.kind = Cell::Kind::PendingParameter;
    pending.parameter = &parameter;
  }
  for (const BodyStep& step : body_.steps) {
    if (step.kind != BodyStep::Kind::Let) continue;
    Cell& pending = cell(step.slot);
    pending.kind = Cell::Kind::PendingLet;
    pending.let = step.value.get();
  }
}

void SymbolicWalker::take_walked(MatchRoles& out) {
  walked_.swap(out.walked);
  out.everywhere = everywhere_;
}

void SymbolicWalker::bind(Slot slot, DartRef dart) { bind(slot, SymbolicValue::of(dart)); }

void SymbolicWalker::bind(Slot slot, SymbolicValue value) {
  Cell& target = cell(slot);
  target.kind = Cell::Kind::Ready;
  target.value = std::move(value);
}

// ---- failures -----------------------------------------------------------------------------------

void SymbolicWalker::fail(DiagnosticKind kind, Span where, std::string message, std::string help) {
  if (failed()) return;
  failure_ = SpecialiseFailure{false, {kind, std::move(message), where}};
  failure_->diagnostic.help = std::move(help);
}

SpecialiseFailure SymbolicWalker::take_failure() {
  GMSIM_CHECK(failed(), "there is no failure to take");
  SpecialiseFailure failure = std::move(*failure_);
  failure_.reset();
  std::string darts;
  for (std::size_t i = 0; i < body_.nodes.size(); ++i) {
    const std::uint32_t slot = types::index(body_.nodes[i]);
    const bool named = slot < body_.slot_names.size() && !body_.slot_names[slot].empty();
    darts += fmt::format("{}{}{}", i == 0 ? "" : ", ",
                         named ? body_.slot_names[slot] + " = " : std::string(),
                         types::index(item_frame_[slot].value.dart.dart));
  }
  failure.diagnostic.notes.push_back(fmt::format("in `{}` at the match {}", body_.name, darts));
  return failure;
}

// ---- locals -------------------------------------------------------------------------------------

const SymbolicValue& SymbolicWalker::local(const Expr& expr) {
  Cell& target = cell(expr.slot);
  if (target.kind == Cell::Kind::Ready) return target.value;
  if (failed()) return target.value;
  const bool pending =
      target.kind == Cell::Kind::PendingLet || target.kind == Cell::Kind::PendingParameter;
  GMSIM_CHECK(pending, fmt::format("local {} of `{}` is read before it has a value",
                                   types::index(expr.slot), body_.name));
  const bool let = target.kind == Cell::Kind::PendingLet;
  target.kind = Cell::Kind::Running;
  SymbolicValue value = let ? evaluate(*target.let) : read_parameter(*target.parameter, expr);
  target.value = std::move(value);
  target.kind = Cell::Kind::Ready;
  return target.value;
}

SymbolicValue SymbolicWalker::let(const Expr& expr) {
  Cell bound;
  bound.kind = Cell::Kind::Ready;
  bound.value = evaluate(*expr.args[0]);
  std::swap(cell(expr.slot), bound);
  SymbolicValue value = evaluate(*expr.args[1]);
  std::swap(cell(expr.slot), bound);
  return value;
}

// ---- decisions ----------------------------------------------------------------------------------

SymbolicValue SymbolicWalker::conditions() {
  SymbolicValue all = SymbolicValue::of(1.0);
  for (const BodyStep& step : body_.steps) {
    if (step.kind != BodyStep::Kind::Where || failed()) continue;
    SymbolicValue condition = evaluate(*step.value);
    if (condition.known) {
      if (condition.number == 0.0) return condition;
      continue;
    }
    if (all.known) {
      all = std::move(condition);
    } else if (graph_ != nullptr) {
      all.parts[0] = make(*step.value, Op::And, all.parts[0], condition.parts[0]);
    }
  }
  return all;
}

/// The outcome of a condition that decides which dart or collection is meant.
bool SymbolicWalker::decided(const Expr& condition, const char* what) {
  const SymbolicValue value = evaluate(condition);
  if (!value.known) {
    fail(DiagnosticKind::NotConstant, condition.span,
         fmt::format("which {} this is depends on numbers that may change at every step", what),
         "choose between values instead: `if … then x.position else y.position`");
  }
  return value.known && value.number != 0.0;
}

SymbolicValue SymbolicWalker::choice(const Expr& expr) {
  const SymbolicValue condition = evaluate(*expr.args[0]);
  if (condition.known) return operand(*expr.args[condition.number != 0.0 ? 1 : 2], expr.type);
  const SymbolicValue yes = operand(*expr.args[1], expr.type);
  const SymbolicValue no = operand(*expr.args[2], expr.type);
  if (graph_ == nullptr || failed()) return {};
  return select(expr, condition.parts[0], yes, no);
}

SymbolicValue SymbolicWalker::select(const Expr& expr, NodeId mask, const SymbolicValue& yes,
                                     const SymbolicValue& no) {
  SymbolicValue value;
  if (expr.type.kind == ValueKind::Bool && !expr.type.is_array()) {
    const NodeId when = make(expr, Op::And, mask, node(yes, expr.type));
    const NodeId unless = make(expr, Op::And, make(expr, Op::Not, mask), node(no, expr.type));
    value.parts = {make(expr, Op::Or, when, unless)};
    return value;
  }
  const std::size_t count = yes.known || no.known ? 1 : yes.parts.size();
  for (std::size_t k = 0; k < count; ++k)
    value.parts.push_back(make(expr, Op::Select, mask, part(yes, k), part(no, k)));
  return value;
}

SymbolicValue SymbolicWalker::link_question(const Expr& expr) {
  const DartRef a = dart(*expr.args[0]);
  if (failed()) return SymbolicValue::of(0.0);
  DartRef b;
  if (expr.kind == ExprKind::Free) {
    b = {world_.map.alpha(expr.number, a.dart), trace_.follow(a.walk, expr.number)};
    depend(b.dart);
  } else {
    b = dart(*expr.args[1]);
  }
  const bool same = a.dart == b.dart;
  decide(same ? 1 : 0);
  trace_.test(a.walk, b.walk, same);
  return SymbolicValue::of(same ? 1.0 : 0.0);
}

std::uint32_t SymbolicWalker::meet(OrbitType type, DartRef at) {
  const std::uint32_t role = roles_.role(type, at.dart);
  decide(role);
  trace_.visit(type, at.walk, role, world_.store.find_index(type));
  return role;
}

// ---- darts --------------------------------------------------------------------------------------

DartRef SymbolicWalker::dart(const Expr& expr) {
  if (failed()) return {};
  switch (expr.kind) {
    case ExprKind::Alpha: {
      const DartRef from = dart(*expr.args[0]);
      if (failed()) return from;
      const DartId to = world_.map.alpha(expr.number, from.dart);
      depend(to);
      return {to, trace_.follow(from.walk, expr.number)};
    }
    case ExprKind::Literal: {
      trace_.spoil();
      depend(expr.value.dart);
      if (!world_.map.alive(expr.value.dart)) {
        fail(DiagnosticKind::NoMatch, expr.span,
             fmt::format("dart {} is no longer part of the map", types::index(expr.value.dart)));
      }
      return {expr.value.dart, kNoWalk};
    }
    case ExprKind::If:
      return dart(*expr.args[decided(*expr.args[0], "dart") ? 1 : 2]);
    default:
      return evaluate(expr).dart;
  }
}

// ---- values -------------------------------------------------------------------------------------

SymbolicValue SymbolicWalker::evaluate(const Expr& expr) {
  if (failed()) return {};
  switch (expr.kind) {
    case ExprKind::Literal:
      if (expr.type.kind == ValueKind::Dart) return SymbolicValue::of(dart(expr));
      return constant(expr.type, expr.value.data);
    case ExprKind::Local:
      return local(expr);
    case ExprKind::Let:
      return let(expr);
    case ExprKind::Alpha:
      return SymbolicValue::of(dart(expr));
    case ExprKind::Free:
    case ExprKind::SameDart:
      return link_question(expr);
    case ExprKind::Embedding:
      return read(expr, expr.embedding, dart(*expr.args[0]));
    case ExprKind::Has:
      return has(expr);
    case ExprKind::Time:
    case ExprKind::Step:
    case ExprKind::Dt:
      return clock(expr);
    case ExprKind::Random:
      return random(expr);
    case ExprKind::OrbitDarts:
    case ExprKind::Quotient:
    case ExprKind::Polygon:
    case ExprKind::AllOrbits: {
      SymbolicValue value;
      value.darts = members(expr);
      return value;
    }
    case ExprKind::Range: {
      SymbolicValue range = evaluate(*expr.args[0]);
      const SymbolicValue upper = evaluate(*expr.args[1]);
      range.upper = upper.number;
      if (!range.known || !upper.known) {
        fail(DiagnosticKind::NotConstant, expr.span,
             "the ends of this range depend on numbers that may change at every step");
      }
      return range;
    }
    case ExprKind::Forces:
      return atomic_forces(expr);
    case ExprKind::ForceOn:
      return force_on(expr);
    case ExprKind::Fold:
      return fold(expr);
    case ExprKind::Neg:
    case ExprKind::Add:
    case ExprKind::Sub:
    case ExprKind::Mul:
    case ExprKind::Div:
    case ExprKind::Pow:
      return arithmetic(expr);
    case ExprKind::Less:
    case ExprKind::LessEqual:
    case ExprKind::Greater:
    case ExprKind::GreaterEqual:
      return comparison(expr);
    case ExprKind::Equal:
    case ExprKind::NotEqual:
      return equality(expr);
    case ExprKind::And:
    case ExprKind::Or:
    case ExprKind::Not:
      return logic(expr);
    case ExprKind::If:
      if (expr.type.kind == ValueKind::Dart) return SymbolicValue::of(dart(expr));
      if (expr.type.kind == ValueKind::Darts)
        return evaluate(*expr.args[decided(*expr.args[0], "collection") ? 1 : 2]);
      return choice(expr);
    case ExprKind::Tuple:
      return tuple(expr);
    case ExprKind::Component:
      return component(expr);
    case ExprKind::Index:
      return element(expr);
    case ExprKind::Call:
      return call(expr);
    case ExprKind::Convert:
      return operand(*expr.args[0], expr.type);
    case ExprKind::Grad:
      return grad(expr);
    case ExprKind::Frozen: {
      SymbolicValue value = evaluate(*expr.args[0]);
      if (expr.type.kind == ValueKind::Bool) return value;  // masks have no derivative anyway
      for (NodeId& id : value.parts) id = make(expr, Op::Frozen, id);
      return value;
    }
  }
  return {};
}

ir::NodeId SymbolicWalker::node(const SymbolicValue& value, const types::ValueType& type) {
  if (graph_ == nullptr || failed()) return ir::kNone;
  if (!value.known) return part(value, 0);
  return type.kind == ValueKind::Bool ? graph_->mask(value.number != 0.0)
                                      : graph_->constant(value.number);
}

std::vector<ir::NodeId> SymbolicWalker::nodes(const SymbolicValue& value,
                                              const types::ValueType& type) {
  if (graph_ == nullptr || failed()) return {};
  if (value.known) return {graph_->constant(value.number)};
  if (type.kind == ValueKind::Bool && !type.is_array())
    return {graph_->make(Op::AsReal, part(value, 0))};
  return value.parts;
}

}  // namespace gmsim::compile
