// SPDX-License-Identifier: MIT
#include "types/expr.h"

#include <string_view>

#include "support/check.h"

namespace gmsim::types {
namespace {

/// Sharing can make an expression's text exponentially long; it ends with an ellipsis here.
constexpr std::size_t kLongestText = 4000;

/// How tightly a form binds, loosest first, as in the precedence table of the grammar.
enum class Binding { If, Or, And, Not, Compare, Sum, Product, Negation, Power, Postfix };

Binding tighter(Binding binding) {
  return static_cast<Binding>(static_cast<int>(binding) + 1);
}

struct Operator {
  std::string_view text;
  Binding binding;
};

/// The infix operator of a kind; empty text when it is not one.
Operator infix(ExprKind kind) {
  switch (kind) {
    case ExprKind::Or:
      return {" or ", Binding::Or};
    case ExprKind::And:
      return {" and ", Binding::And};
    case ExprKind::Less:
      return {" < ", Binding::Compare};
    case ExprKind::LessEqual:
      return {" <= ", Binding::Compare};
    case ExprKind::Greater:
      return {" > ", Binding::Compare};
    case ExprKind::GreaterEqual:
      return {" >= ", Binding::Compare};
    case ExprKind::SameDart:
    case ExprKind::Equal:
      return {" == ", Binding::Compare};
    case ExprKind::NotEqual:
      return {" != ", Binding::Compare};
    case ExprKind::Add:
      return {" + ", Binding::Sum};
    case ExprKind::Sub:
      return {" - ", Binding::Sum};
    case ExprKind::Mul:
      return {" * ", Binding::Product};
    case ExprKind::Div:
      return {" / ", Binding::Product};
    case ExprKind::Pow:
      return {"^", Binding::Power};
    default:
      return {"", Binding::Postfix};
  }
}

bool prints_minus(const Value& value) {
  const ValueKind kind = value.type.kind;
  const bool number = kind == ValueKind::Int || kind == ValueKind::Real;
  return number && !value.type.is_array() && to_string(value).starts_with('-');
}

Binding binding_of(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Let:
      return expr.number == 0 ? Binding::If : binding_of(*expr.args.at(1));
    case ExprKind::If:
      return Binding::If;
    case ExprKind::Not:
      return Binding::Not;
    case ExprKind::Neg:
      return Binding::Negation;
    case ExprKind::Quotient:
      return Binding::Product;
    case ExprKind::Convert:
      return binding_of(*expr.args.at(0));
    case ExprKind::Literal:
      return prints_minus(expr.value) ? Binding::Negation : Binding::Postfix;
    default:
      return infix(expr.kind).binding;
  }
}

std::string_view name_of(FoldKind kind) {
  switch (kind) {
    case FoldKind::Sum:
      return "sum";
    case FoldKind::Mean:
      return "mean";
    case FoldKind::Min:
      return "min";
    case FoldKind::Max:
      return "max";
    case FoldKind::Count:
      return "count";
    case FoldKind::Any:
      return "any";
    case FoldKind::All:
      return "all";
    case FoldKind::ArgMax:
      return "argmax";
    case FoldKind::ArgMin:
      return "argmin";
  }
  return {};
}

std::string_view component_name(const Expr& expr) {
  constexpr std::string_view kAxes[] = {"x", "y", "z"};
  if (expr.args.at(0)->type.kind == ValueKind::EigenPair)
    return expr.number == 0 ? "value" : "vector";
  GMSIM_CHECK(expr.number >= 0 && expr.number < 3, "a vector has components 0 to 2");
  return kAxes[expr.number];
}

class Printer {
 public:
  explicit Printer(const ExprNames& names) : names_(names) {}

  /// Prints in parentheses what binds more loosely than `least`.
  void print(const Expr& expr, Binding least) {
    if (text_.size() > kLongestText) return;
    const bool parentheses = binding_of(expr) < least;
    if (parentheses) text_ += '(';
    print_bare(expr);
    if (parentheses) text_ += ')';
  }

  [[nodiscard]] std::string take() {
    if (text_.size() > kLongestText) text_ = text_.substr(0, kLongestText) + "…";
    return std::move(text_);
  }

 private:
  void print_bare(const Expr& e) {
    switch (e.kind) {
      case ExprKind::Literal:
        text_ += to_string(e.value);
        break;
      case ExprKind::Local:
        text_ += slot_name(e.slot);
        break;
      case ExprKind::Let:
        if (e.number != 0) return print_bare(*e.args.at(1));  // shared, not written by the author
        text_ += "let " + slot_name(e.slot) + " = ";
        arg(e, 0);
        text_ += "; ";
        arg(e, 1);
        break;
      case ExprKind::Alpha:
        arg(e, 0, Binding::Postfix);
        text_ += "@" + std::to_string(e.number);
        break;
      case ExprKind::Free:
        text_ += "free(";
        arg(e, 0);
        text_ += ", " + std::to_string(e.number) + ")";
        break;
      case ExprKind::Embedding:
        member(e, embedding_name(e.embedding));
        break;
      case ExprKind::Has:
        has(e, embedding_name(e.embedding));
        break;
      case ExprKind::Time:
        text_ += "time";
        break;
      case ExprKind::Step:
        text_ += "step";
        break;
      case ExprKind::Dt:
        text_ += "dt";
        break;
      case ExprKind::Random:
        text_ += "random(";
        arg(e, 0);
        text_ += ", ";
        orbit(e, 1);
        text_ += ")";
        break;
      case ExprKind::OrbitDarts:
        orbit(e, 0);
        break;
      case ExprKind::Quotient:
        orbit(e, 0);
        text_ += " / " + to_string(e.orbit2);
        break;
      case ExprKind::AllOrbits:
        text_ += "all " + to_string(e.orbit);
        break;
      case ExprKind::Range:
        arg(e, 0, Binding::Sum);
        text_ += "..";
        arg(e, 1, Binding::Sum);
        break;
      case ExprKind::Forces:
        text_ += "forces(";
        orbit(e, 0);
        text_ += ")";
        break;
      case ExprKind::ForceOn:
        text_ += "force_on(";
        orbit(e, 0);
        if (e.number == 1) text_ += ", " + interaction_name(e.interaction);
        text_ += ")";
        break;
      case ExprKind::Fold:
        fold(e);
        break;
      case ExprKind::Neg:
        text_ += "-";
        arg(e, 0, Binding::Power);
        break;
      case ExprKind::Not:
        text_ += "not ";
        arg(e, 0, Binding::Not);
        break;
      case ExprKind::SameDart:
      case ExprKind::Add:
      case ExprKind::Sub:
      case ExprKind::Mul:
      case ExprKind::Div:
      case ExprKind::Pow:
      case ExprKind::Less:
      case ExprKind::LessEqual:
      case ExprKind::Greater:
      case ExprKind::GreaterEqual:
      case ExprKind::Equal:
      case ExprKind::NotEqual:
      case ExprKind::And:
      case ExprKind::Or:
        binary(e);
        break;
      case ExprKind::If:
        text_ += "if ";
        arg(e, 0, Binding::Or);
        text_ += " then ";
        arg(e, 1);
        text_ += " else ";
        arg(e, 2);
        break;
      case ExprKind::Tuple:
        call("", e);
        break;
      case ExprKind::Component:
        member(e, component_name(e));
        break;
      case ExprKind::Index:
        arg(e, 0, Binding::Postfix);
        text_ += "[";
        arg(e, 1);
        text_ += "]";
        break;
      case ExprKind::Polygon:
        call("polygon", e);
        break;
      case ExprKind::Call:
        call(info(e.builtin).name, e);
        break;
      case ExprKind::Convert:
        print_bare(*e.args.at(0));
        break;
      case ExprKind::Grad:
        call("grad", e);
        break;
      case ExprKind::Frozen:
        call("frozen", e);
        break;
    }
  }

  void arg(const Expr& expr, std::size_t i, Binding least = Binding::If) {
    print(*expr.args.at(i), least);
  }

  void binary(const Expr& expr) {
    const Operator op = infix(expr.kind);
    const bool comparison = op.binding == Binding::Compare;
    const bool power = op.binding == Binding::Power;
    arg(expr, 0, comparison || power ? tighter(op.binding) : op.binding);
    text_ += op.text;
    arg(expr, 1, power ? op.binding : tighter(op.binding));
  }

  void call(std::string_view name, const Expr& expr) {
    text_ += name;
    text_ += '(';
    for (std::size_t i = 0; i < expr.args.size(); ++i) {
      if (i > 0) text_ += ", ";
      arg(expr, i);
    }
    text_ += ')';
  }

  void orbit(const Expr& expr, std::size_t dart) {
    text_ += to_string(expr.orbit) + "(";
    arg(expr, dart);
    text_ += ')';
  }

  void member(const Expr& expr, std::string_view name) {
    arg(expr, 0, Binding::Postfix);
    text_ += '.';
    text_ += name;
  }

  void has(const Expr& expr, std::string_view name) {
    text_ += "has(";
    member(expr, name);
    text_ += ')';
  }

  void fold(const Expr& expr) {
    text_ += name_of(expr.fold);
    text_ += "(" + slot_name(expr.slot) + " in ";
    arg(expr, 0);
    for (std::size_t i = 1; i < expr.args.size(); ++i) {
      text_ += " : ";
      arg(expr, i);
    }
    text_ += ')';
  }

  static std::string name_at(const std::vector<std::string>& names, std::uint32_t i) {
    return i < names.size() ? names[i] : "#" + std::to_string(i);
  }
  [[nodiscard]] std::string slot_name(Slot slot) const {
    return name_at(names_.slots, index(slot));
  }
  [[nodiscard]] std::string embedding_name(EmbeddingId id) const {
    return name_at(names_.embeddings, index(id));
  }
  [[nodiscard]] std::string interaction_name(InteractionId id) const {
    return name_at(names_.interactions, index(id));
  }

  const ExprNames& names_;
  std::string text_;
};

}  // namespace

std::string to_string(const Expr& expr, const ExprNames& names) {
  Printer printer(names);
  printer.print(expr, Binding::If);
  return printer.take();
}

}  // namespace gmsim::types
