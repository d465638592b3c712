// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/item_context.h"
#include "check/make_expr.h"
#include "check/resolve.h"
#include "check/unit_rules.h"

namespace gmsim::check {

/// What a place asks of an expression.
struct Wanted {
  ValueType type;
  types::MaybeUnit unit = std::nullopt;
  double scale = 1.0;  ///< bare numbers are multiples of this many SI units
  std::string what;    ///< "`energy`", for messages
};

/// From the tree of an expression to its checked form. Names are resolved in the context's scope;
/// functions and macros are expanded; constants are folded. A mistake is reported where it is found
/// and gives an expression of type Error, which agrees with everything.
class ExprChecker {
 public:
  explicit ExprChecker(ItemContext& context) : context_(context) {}

  /// Any type. Never null.
  [[nodiscard]] ExprPtr check(const syntax::Expr& expr);
  [[nodiscard]] ExprPtr check(const syntax::ExprPtr& expr);
  /// Converted to the wanted type and unit.
  [[nodiscard]] ExprPtr check_as(const syntax::ExprPtr& expr, const Wanted& wanted);
  [[nodiscard]] ExprPtr coerce(const ExprPtr& expr, const Wanted& wanted);
  [[nodiscard]] ExprPtr check_condition(const syntax::ExprPtr& expr, const std::string& what);
  [[nodiscard]] ExprPtr check_dart(const syntax::ExprPtr& expr, const std::string& what);
  /// Darts, atomic forces or a range.
  [[nodiscard]] ExprPtr check_collection(const syntax::ExprPtr& expr);
  /// The variable of a fold, `for` or `force … in` over `collection`, added to the scope.
  ExprPtr declare_variable(const syntax::Name& name, const ExprPtr& collection);
  /// The macro or the value of a `let`; adds the name. Returns the step that computes it, unless the
  /// value stands wherever the name does. `inline_walks`: darts found by links are such values.
  std::optional<Step> check_let(const syntax::LetStatement& let, Span span, bool inline_walks);

  /// The embedding of an assignment's target: `position`, or `stretch_spring` and `rest`.
  std::optional<EmbeddingId> find_value(const syntax::Name& name);
  std::optional<EmbeddingId> find_member(const syntax::Name& owner, const syntax::Name& member);
  /// Whether a name after `.` means an interaction or a family here.
  [[nodiscard]] bool names_interaction(const std::string& name) const;

 private:
  // names, members (check_names.cpp)
  ExprPtr name(const syntax::NameExpr& expr, Span span);
  ExprPtr unknown_name(const syntax::Name& name);
  ExprPtr member(const syntax::MemberExpr& expr, Span span);
  ExprPtr component(const ExprPtr& object, const syntax::Name& name, Span span);
  ExprPtr embedding_read(const ExprPtr& dart, const syntax::Name& name, Span span);
  ExprPtr interaction_read(const ExprPtr& dart, const syntax::Name& owner,
                           const syntax::Name& member, Span span);
  ExprPtr family_read(const ExprPtr& dart, const Family& family, const syntax::Name& member,
                      Span span);
  ExprPtr read(ExprKind kind, const ExprPtr& dart, EmbeddingId embedding, Span span);
  std::optional<ValueRef> find_value_ref(const syntax::Name& name);
  std::optional<std::pair<ExprPtr, const syntax::Name*>> interaction_owner(
      const syntax::Expr& object);
  std::string describe_value(const std::string& name) const;

  // operators (check_operators.cpp)
  ExprPtr unary(const syntax::UnaryExpr& expr, Span span);
  ExprPtr binary(const syntax::BinaryExpr& expr, Span span);
  ExprPtr logic(const syntax::BinaryExpr& expr, Span span);
  ExprPtr comparison(const syntax::BinaryExpr& expr, Span span);
  ExprPtr sum(const syntax::BinaryExpr& expr, Span span);
  ExprPtr product(const syntax::BinaryExpr& expr, Span span);
  ExprPtr division(const syntax::BinaryExpr& expr, Span span);
  ExprPtr quotient(const ExprPtr& orbit, const syntax::BinaryExpr& expr, Span span);
  ExprPtr power(const syntax::BinaryExpr& expr, Span span);
  ExprPtr choice(const syntax::IfExpr& expr, Span span);
  ExprPtr tuple(const syntax::TupleExpr& expr, Span span);
  ExprPtr index(const syntax::IndexExpr& expr, Span span);
  ExprPtr operator_mismatch(const syntax::BinaryExpr& expr, const ExprPtr& a, const ExprPtr& b);
  bool unify(ExprPtr& a, ExprPtr& b, Span place, const std::string& what);
  bool unify_units(ExprPtr& a, ExprPtr& b, Span place, const std::string& what);
  double declared_scale(const types::Expr& expr) const;

  // calls (check_calls.cpp, check_forms.cpp)
  ExprPtr call(const syntax::CallExpr& expr, Span span);
  ExprPtr builtin_call(types::Builtin builtin, const syntax::CallExpr& expr, Span span);
  ExprPtr function_call(ItemIndex function, const syntax::CallExpr& expr, Span span);
  ExprPtr macro_call(const Binding& macro, const syntax::CallExpr& expr, Span span);
  ExprPtr expand(const syntax::Name& callee, const std::vector<syntax::Name>& parameters,
                 const syntax::ExprPtr& body, const std::vector<ExprPtr>& arguments, Scope scope,
                 Span span);
  bool check_count(const syntax::CallExpr& expr, std::size_t wanted);
  std::optional<std::vector<ExprPtr>> arguments(const syntax::CallExpr& expr);
  ExprPtr orbit_call(OrbitType orbit, const syntax::ExprPtr& argument, Span span);
  ExprPtr unknown_function(const syntax::Name& name);
  std::optional<ExprPtr> form(const syntax::CallExpr& expr, Span span);
  ExprPtr has_form(const syntax::CallExpr& expr, Span span);
  ExprPtr free_form(const syntax::CallExpr& expr, Span span);
  ExprPtr random_form(const syntax::CallExpr& expr, Span span);
  ExprPtr forces_form(const syntax::CallExpr& expr, Span span);
  ExprPtr force_on_form(const syntax::CallExpr& expr, Span span);
  ExprPtr grad_form(const syntax::CallExpr& expr, Span span);
  ExprPtr frozen_form(const syntax::CallExpr& expr, Span span);
  ExprPtr polygon_form(const syntax::CallExpr& expr, Span span);
  ExprPtr orbit_argument(const syntax::ExprPtr& expr, const std::string& what);
  bool forces_allowed(Span span);

  // folds (check_folds.cpp)
  ExprPtr fold(const syntax::FoldExpr& expr, Span span);
  ExprPtr fold_body(types::FoldKind kind, const syntax::FoldExpr& expr, Span span);
  ExprPtr range(const syntax::RangeExpr& expr, Span span);
  ExprPtr all(const syntax::AllExpr& expr, Span span);

  ExprPtr number(const syntax::NumberExpr& expr, Span span);
  ExprPtr walk(const syntax::WalkExpr& expr, Span span);
  ExprPtr require_dart(const ExprPtr& expr, const std::string& what);
  ExprPtr type_mismatch(Span place, std::string message, std::string help = {});
  ExprPtr make(ExprKind kind, ValueType type, types::MaybeUnit unit, Span span,
               std::vector<ExprPtr> args);

  ItemContext& context_;
  int depth_ = 0;
};

/// "a real", "an int", "a collection of darts", … for messages.
[[nodiscard]] std::string found_text(const ExprPtr& expr);

/// Checks the body of a function by itself, once: names, and what does not depend on the types of
/// its arguments.
void check_function(Environment& environment, ItemIndex function,
                    const support::SourceMap& sources);

}  // namespace gmsim::check
