// SPDX-License-Identifier: MIT
// Forces as values: what criteria and fields read of them.
#include <memory>
#include <utility>

#include "compile/symbolic_walker.h"

namespace gmsim::compile {

using ir::Input;
using types::Expr;
using types::ValueKind;

bool SymbolicWalker::forces_can_be_read(const Expr& expr) {
  if (world_.atomic_forces != nullptr) return true;
  fail(support::DiagnosticKind::NotAvailable, expr.span, "forces cannot be read here",
       "criteria and output fields read them while a scene runs");
  return false;
}

SymbolicValue SymbolicWalker::force_on(const Expr& expr) {
  const DartRef at = dart(*expr.args[0]);
  if (failed() || !forces_can_be_read(expr)) return {};
  const std::uint32_t role = meet(expr.orbit, at);
  if (graph_ == nullptr) return {};
  const std::uint32_t only = expr.number == 1 ? types::index(expr.interaction) + 1 : 0;
  const Input input{.source = Input::Source::ForceOn, .role = role, .offset = only};
  return of_parts({graph_->input(input, ValueKind::Vec3, expr.span)});
}

SymbolicValue SymbolicWalker::atomic_forces(const Expr& expr) {
  const DartRef at = dart(*expr.args[0]);
  if (failed() || !forces_can_be_read(expr)) return {};
  std::vector<std::uint32_t> rows;
  world_.atomic_forces->list(expr.orbit, at.dart, rows);
  decide(static_cast<std::uint32_t>(rows.size()));
  depend(expr.orbit, at.dart);
  trace_.list(expr.orbit, at.walk, static_cast<std::uint32_t>(rows.size()));
  auto numbers = std::make_shared<std::vector<std::uint32_t>>();
  for (const std::uint32_t row : rows) {
    numbers->push_back(static_cast<std::uint32_t>(atomic_.size()));
    atomic_.push_back(row);
  }
  SymbolicValue value;
  value.forces = std::move(numbers);
  return value;
}

SymbolicValue SymbolicWalker::atomic_force(const Expr& collection, std::uint32_t number) {
  if (graph_ == nullptr) return {};
  const Input input{.source = Input::Source::AtomicForce, .role = number};
  return of_parts({graph_->input(input, ValueKind::Vec3, collection.span)});
}

}  // namespace gmsim::compile
