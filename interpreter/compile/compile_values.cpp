// SPDX-License-Identifier: MIT
#include "compile/compile_values.h"

#include <algorithm>

#include "compile/value_compiler.h"

namespace gmsim::compile {

using types::Expr;
using types::ExprKind;
using types::ValueKind;

std::uint32_t lane_components(const types::ValueType& type) {
  return type.kind == ValueKind::Dart ? 1 : types::number_count(type);
}

ValueProgram compile_values(const Rule& rule, const gmap::EmbeddingSchema& schema,
                            const std::vector<bool>& in_use) {
  try {
    return ValueCompiler(rule, schema, in_use).run();
  } catch (const ValueCompiler::NotExpressible&) {
  } catch (const ValueGraph::LanesDiffer&) {
  }
  return {.complete = false};
}

ValueProgram ValueCompiler::run() {
  std::vector<ValueProgram::Output> outputs;
  for (std::uint32_t k = 0; k < rule_.rewrite.assignments.size(); ++k) {
    const Assignment& assignment = rule_.rewrite.assignments[k];
    if (in_use_[types::index(assignment.embedding)]) outputs.push_back({k, assigned(assignment)});
  }
  return graph_.finish(std::move(outputs));
}

ValueId ValueCompiler::assigned(const Assignment& assignment) {
  graph_.choose_rows(assignment.joined_rows());
  scope_ = rows_ = graph_.rows(0);
  locals_.assign(rule_.frame_size, Bound{});
  for (Column column = 0; column < rule_.match.nodes.size(); ++column) {
    ValueInstruction node{.op = ValueOp::Node, .domain = rows_};
    node.number = static_cast<std::int32_t>(column);
    locals_[types::index(rule_.match.nodes[column].slot)] = {Bound::Kind::Value, graph_.add(node)};
  }
  for (const Predicate& predicate : rule_.match.predicates) {
    if (predicate.kind != Predicate::Kind::Let) continue;
    Bound& bound = locals_[types::index(predicate.slot)];
    bound.kind = Bound::Kind::Later;
    bound.later = predicate.value.get();
  }
  const std::uint32_t count = types::component_count(schema_[assignment.embedding].type);
  return graph_.spread(operand(*assignment.value, count), rows_);
}

ValueId ValueCompiler::make(ValueOp op, std::uint32_t count, std::initializer_list<ValueId> args,
                            std::int32_t number) {
  ValueInstruction instruction{.op = op, .count = count};
  std::copy(args.begin(), args.end(), instruction.args.begin());
  instruction.number = number;
  return graph_.add(instruction);
}

ValueId ValueCompiler::zeros(std::uint32_t count) {
  return graph_.constant(std::vector<double>(count, 0.0));
}

// ---- locals -------------------------------------------------------------------------------------

const ValueCompiler::Bound& ValueCompiler::local(Slot slot) {
  Bound& bound = locals_[types::index(slot)];
  if (bound.kind == Bound::Kind::Later) {
    const Restored<DomainId> outermost(scope_, rows_);
    Bound value = value_of(*bound.later);
    bound = std::move(value);
  }
  return bound;
}

ValueCompiler::Bound ValueCompiler::value_of(const Expr& expr) {
  Bound bound{.kind = Bound::Kind::Value};
  if (expr.type.kind == ValueKind::Darts || expr.type.kind == ValueKind::Range) {
    bound.kind = Bound::Kind::Members;
    bound.members = collection(expr);
  } else {
    bound.value = expr.type.kind == ValueKind::Dart ? dart(expr) : number(expr);
  }
  return bound;
}

template <typename Body>
auto ValueCompiler::with_let(const Expr& let, const Body& body) {
  const Binding binding(locals_, let.slot, value_of(*let.args[0]));
  return body(*let.args[1]);
}

// ---- darts --------------------------------------------------------------------------------------

ValueId ValueCompiler::dart(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Local: {
      const Bound& bound = local(expr.slot);
      if (bound.kind != Bound::Kind::Value) throw NotExpressible{};  // a dart may be gone
      return bound.value;
    }
    case ExprKind::Alpha:
      return make(ValueOp::Alpha, 1, {dart(*expr.args[0])}, expr.number);
    case ExprKind::Let:
      return with_let(expr, [&](const Expr& body) { return dart(body); });
    case ExprKind::If: {
      const ValueId condition = number(*expr.args[0]);
      if (const auto value = graph_.known_number(condition))
        return dart(*expr.args[*value != 0.0 ? 1 : 2]);
      return make(ValueOp::ChooseDart, 1, {condition, dart(*expr.args[1]), dart(*expr.args[2])});
    }
    case ExprKind::Fold:
      return fold(expr);
    default:
      throw NotExpressible{};
  }
}

// ---- numbers ------------------------------------------------------------------------------------

ValueId ValueCompiler::operand(const Expr& expr, std::uint32_t count) {
  return expr.type.kind == ValueKind::Zero ? zeros(count) : number(expr);
}

ValueId ValueCompiler::number(const Expr& expr) {
  const auto argument = [&](std::size_t k) -> const Expr& { return *expr.args[k]; };
  const std::uint32_t count = lane_components(expr.type);
  switch (expr.kind) {
    case ExprKind::Literal:
      return expr.value.data.empty() ? zeros(count) : graph_.constant(expr.value.data);
    case ExprKind::Local: {
      const Bound& bound = local(expr.slot);
      if (bound.kind == Bound::Kind::Value) return bound.value;
      return make(ValueOp::Parameter, count, {},
                  static_cast<std::int32_t>(types::index(expr.slot)));
    }
    case ExprKind::Let:
      return with_let(expr, [&](const Expr& body) { return number(body); });
    case ExprKind::Embedding:
      return read(expr.embedding, dart(argument(0)));
    case ExprKind::Has:
      return has(expr.embedding, dart(argument(0)));
    case ExprKind::Free:
      return make(ValueOp::Free, 1, {dart(argument(0))}, expr.number);
    case ExprKind::SameDart:
      return make(ValueOp::SameDart, 1, {dart(argument(0)), dart(argument(1))});
    case ExprKind::Time:
      return make(ValueOp::Time, 1, {});
    case ExprKind::Step:
      return make(ValueOp::Step, 1, {});
    case ExprKind::Dt:
      return make(ValueOp::Dt, 1, {});
    case ExprKind::Random: {
      const ValueId at = graph_.any_dart_of(expr.orbit, dart(argument(1)));
      ValueInstruction random{.op = ValueOp::Random,
                              .args = {number(argument(0)), at, LaneDomain::kNone}};
      random.orbit = expr.orbit;
      return graph_.add(random);
    }
    case ExprKind::Fold:
      return fold(expr);
    case ExprKind::If:
      return choice(expr);
    case ExprKind::And:
    case ExprKind::Or:
      return logic(expr);
    case ExprKind::Not:
      return make(ValueOp::Not, 1, {number(argument(0))});
    case ExprKind::Less:
    case ExprKind::LessEqual:
    case ExprKind::Greater:
    case ExprKind::GreaterEqual:
    case ExprKind::Equal:
    case ExprKind::NotEqual:
      return compared(expr);
    case ExprKind::Frozen:
      return number(argument(0));
    case ExprKind::Convert:
      return operand(argument(0), count);
    case ExprKind::Call:
      return call(expr);
    case ExprKind::Tuple: {
      ValueInstruction tuple{.op = ValueOp::Tuple, .count = count};
      for (std::size_t k = 0; k < expr.args.size(); ++k) tuple.args[k] = number(argument(k));
      return graph_.add(tuple);
    }
    case ExprKind::Component:  // of a vector, or value and vector of an eigenpair
      return make(ValueOp::Part, count, {number(argument(0))}, expr.number);
    case ExprKind::Index:
      return make(ValueOp::Element, count, {number(argument(0)), number(argument(1))},
                  static_cast<std::int32_t>(argument(0).type.extents.front()));
    case ExprKind::Neg:
    case ExprKind::Add:
    case ExprKind::Sub:
    case ExprKind::Mul:
    case ExprKind::Div:
    case ExprKind::Pow:
      return arithmetic(expr);
    default:
      throw NotExpressible{};
  }
}

ValueId ValueCompiler::choice(const Expr& expr) {
  const ValueId condition = number(*expr.args[0]);
  const std::uint32_t count = lane_components(expr.type);
  if (const auto value = graph_.known_number(condition)) {
    return operand(*expr.args[*value != 0.0 ? 1 : 2], count);
  }
  return make(ValueOp::Choose, count,
              {condition, operand(*expr.args[1], count), operand(*expr.args[2], count)});
}

ValueId ValueCompiler::logic(const Expr& expr) {
  const bool all = expr.kind == ExprKind::And;
  const ValueId first = number(*expr.args[0]);
  if (const auto value = graph_.known_number(first); value && (*value != 0.0) != all) return first;
  return make(all ? ValueOp::And : ValueOp::Or, 1, {first, number(*expr.args[1])});
}

ValueId ValueCompiler::compared(const Expr& expr) {
  const Expr &a = *expr.args[0], &b = *expr.args[1];
  if (expr.kind == ExprKind::Equal || expr.kind == ExprKind::NotEqual) {
    const std::uint32_t count = std::max(lane_components(a.type), lane_components(b.type));
    const ValueId equal = make(ValueOp::Equal, 1, {operand(a, count), operand(b, count)});
    return expr.kind == ExprKind::Equal ? equal : make(ValueOp::Not, 1, {equal});
  }
  const bool swap = expr.kind == ExprKind::Greater || expr.kind == ExprKind::GreaterEqual;
  const bool strict = expr.kind == ExprKind::Less || expr.kind == ExprKind::Greater;
  const ValueId left = number(a), right = number(b);
  return make(strict ? ValueOp::Less : ValueOp::LessEqual, 1,
              {swap ? right : left, swap ? left : right});
}

ValueId ValueCompiler::arithmetic(const Expr& expr) {
  const std::uint32_t count = lane_components(expr.type);
  if (expr.kind == ExprKind::Mul) return product(expr);
  const ValueId a = operand(*expr.args[0], count);
  if (expr.kind == ExprKind::Neg) return make(ValueOp::Negate, count, {a});
  if (expr.kind == ExprKind::Add || expr.kind == ExprKind::Sub) {
    return make(expr.kind == ExprKind::Add ? ValueOp::Add : ValueOp::Subtract, count,
                {a, operand(*expr.args[1], count)});
  }
  const ValueId b = number(*expr.args[1]);
  if (expr.kind == ExprKind::Pow) return make(ValueOp::Power, count, {a, b});
  const bool whole = expr.type.kind == ValueKind::Int;
  return make(whole ? ValueOp::DivideWhole : ValueOp::Divide, count, {a, b});
}

ValueId ValueCompiler::product(const Expr& expr) {
  const Expr &left = *expr.args[0], &right = *expr.args[1];
  const std::uint32_t count = lane_components(expr.type);
  const ValueId a = number(left), b = number(right);
  if (count == 1) return make(ValueOp::Multiply, 1, {a, b});
  if (types::is_scalar(left.type)) return make(ValueOp::Scale, count, {a, b});
  if (types::is_scalar(right.type)) return make(ValueOp::Scale, count, {b, a});
  ValueInstruction product{
      .op = ValueOp::Product, .count = count, .args = {a, b, LaneDomain::kNone}};
  product.left = left.type.kind;
  product.right = right.type.kind;
  return graph_.add(product);
}

ValueId ValueCompiler::call(const Expr& expr) {
  constexpr std::uint32_t kMostComponents = 9;  // of an argument
  ValueInstruction call{.op = ValueOp::Call, .count = lane_components(expr.type)};
  for (std::size_t k = 0; k < expr.args.size(); ++k) {
    call.args[k] = operand(*expr.args[k], kMostComponents);
  }
  call.builtin = expr.builtin;
  call.number = expr.number;
  return graph_.add(call);
}

// ---- embeddings ---------------------------------------------------------------------------------

ValueId ValueCompiler::orbit_value(ValueOp op, EmbeddingId id, ValueId dart, std::uint32_t count) {
  ValueInstruction read{.op = op, .count = count};
  read.args[0] = graph_.any_dart_of(schema_[id].orbit, dart);
  read.embedding = id;
  return graph_.add(read);
}

ValueId ValueCompiler::read(EmbeddingId id, ValueId dart) {
  const gmap::EmbeddingDecl& decl = schema_[id];
  if (decl.kind == gmap::EmbeddingKind::Derived && decl.derivation) {
    Locals locals(decl.frame_size);
    ValueInstruction smallest{.op = ValueOp::Smallest, .orbit = decl.orbit};
    smallest.args[0] = graph_.any_dart_of(decl.orbit, dart);
    locals[types::index(decl.dart_slot)] = {Bound::Kind::Value, graph_.add(smallest)};
    const Restored<Locals> own(locals_, std::move(locals));
    return number(*decl.derivation);
  }
  if (in_use_[types::index(id)]) {
    return orbit_value(ValueOp::Read, id, dart, types::component_count(decl.type));
  }
  if (!decl.default_value) throw NotExpressible{};
  return graph_.constant(decl.default_value->data);
}

ValueId ValueCompiler::has(EmbeddingId id, ValueId dart) {
  const gmap::EmbeddingDecl& decl = schema_[id];
  const bool derived = decl.kind == gmap::EmbeddingKind::Derived;
  if (!derived && in_use_[types::index(id)]) return orbit_value(ValueOp::Has, id, dart, 1);
  const bool always = derived ? decl.derivation != nullptr : decl.default_value.has_value();
  const double value = always ? 1.0 : 0.0;
  return graph_.constant({&value, 1});
}

}  // namespace gmsim::compile
