// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "compile/program.h"
#include "compile/value_graph.h"

namespace gmsim::compile {

/// Puts expressions into a value graph.
class ValueCompiler {
 public:
  /// Thrown by what lanes cannot express; ValueGraph::LanesDiffer is another such case.
  struct NotExpressible {};

  ValueCompiler(const Rule& rule, const gmap::EmbeddingSchema& schema,
                const std::vector<bool>& in_use)
      : rule_(rule), schema_(schema), in_use_(in_use), graph_(rule.match) {}

  ValueProgram run();

 private:
  using Expr = types::Expr;

  /// A collection of darts or numbers before its members are listed.
  struct Collection {
    ValueOp op{};
    OrbitType orbit, inner;
    ValueId from = LaneDomain::kNone;  ///< a dart, or the begin of a range
    ValueId to = LaneDomain::kNone;    ///< the end of a range
  };
  /// What a local stands for.
  struct Bound {
    enum class Kind : std::uint8_t { Parameter, Value, Members, Later };
    Kind kind = Kind::Parameter;
    ValueId value = 0;  ///< a dart or a number
    Collection members = {};
    const Expr* later = nullptr;  ///< a `let` of the rule
  };
  using Locals = std::vector<Bound>;

  /// A local for as long as this lives.
  class Binding {
   public:
    Binding(Locals& locals, Slot slot, Bound bound)
        : cell_(locals[types::index(slot)]), outer_(std::exchange(cell_, std::move(bound))) {}
    ~Binding() { cell_ = outer_; }
    Binding(const Binding&) = delete;
    Binding& operator=(const Binding&) = delete;

   private:
    Bound& cell_;
    Bound outer_;
  };
  /// A variable for as long as this lives, on the way out by an exception too.
  template <typename T>
  class Restored {
   public:
    Restored(T& variable, T value)
        : variable_(variable), outer_(std::exchange(variable, std::move(value))) {}
    ~Restored() { variable_ = std::move(outer_); }
    Restored(const Restored&) = delete;
    Restored& operator=(const Restored&) = delete;

   private:
    T& variable_;
    T outer_;
  };

  // compile_values.cpp
  ValueId assigned(const Assignment& assignment);
  ValueId dart(const Expr& expr);
  ValueId number(const Expr& expr);
  /// With `count` components, which the literal 0 takes from the other operand.
  ValueId operand(const Expr& expr, std::uint32_t count);
  const Bound& local(Slot slot);
  Bound value_of(const Expr& expr);
  template <typename Body>
  auto with_let(const Expr& let, const Body& body);
  ValueId read(EmbeddingId id, ValueId dart);
  ValueId has(EmbeddingId id, ValueId dart);
  ValueId orbit_value(ValueOp op, EmbeddingId id, ValueId dart, std::uint32_t count);
  ValueId arithmetic(const Expr& expr);
  ValueId product(const Expr& expr);
  ValueId compared(const Expr& expr);
  ValueId logic(const Expr& expr);
  ValueId choice(const Expr& expr);
  ValueId call(const Expr& expr);
  ValueId make(ValueOp op, std::uint32_t count, std::initializer_list<ValueId> args,
               std::int32_t number = 0);
  ValueId zeros(std::uint32_t count);

  // compile_value_folds.cpp
  Collection collection(const Expr& expr);
  ValueId fold(const Expr& expr);
  [[nodiscard]] bool depends_on(const Expr& term, DomainId domain) const;
  ValueId fold_over(const Expr& expr, ValueId members);
  ValueId open(const Collection& collection, DomainId above);
  DomainId natural_domain(const Collection& collection);

  const Rule& rule_;
  const gmap::EmbeddingSchema& schema_;
  const std::vector<bool>& in_use_;
  ValueGraph graph_;
  Locals locals_;
  DomainId scope_ = 0;  ///< of the fold at hand, or of the rows
  DomainId rows_ = 0;   ///< of the assignment at hand
};

/// As types::number_count; a dart counts as one.
[[nodiscard]] std::uint32_t lane_components(const types::ValueType& type);

}  // namespace gmsim::compile
