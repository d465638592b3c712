// SPDX-License-Identifier: MIT
#include "check/normal_form.h"

#include "support/check.h"

namespace gmsim::check {

using types::ExprKind;
using types::FoldKind;
using types::ValueKind;

namespace {

/// Expressions that a person writes need some hundreds of steps.
constexpr int kMostWork = 100'000;

/// Links over which a dart can be moved without changing whether its link i is free.
types::OrbitType commuting_links(int i, int n) {
  types::OrbitType type{i};
  for (int j = 0; j <= n; ++j)
    if (j - i >= 2 || i - j >= 2) type.insert(j);
  return type;
}

std::string text(types::OrbitType type) {
  return std::to_string(type.bits());
}

}  // namespace

NormalForms::NormalForms(const Pattern& left, const KnownLinks& links,
                         const gmap::EmbeddingSchema& schema, const std::vector<Step>& steps)
    : links_(links), schema_(schema), steps_(steps), darts_(links) {
  for (NodeIndex node = 0; node < left.nodes.size(); ++node)
    node_of_slot_[types::index(left.nodes[node].slot)] = node;
}

int NormalForms::of(const Expr& expr, std::optional<std::uint8_t> position) {
  position_ = position;
  locals_.clear();
  done_.clear();
  work_ = 0;
  open_folds_ = 0;
  walked_ = 0;
  for (const Step& step : steps_)
    if (step.kind == Step::Kind::Let) bind(step.slot, evaluate(*step.value));
  const Form form = evaluate(expr);
  if (work_ > kMostWork) return intern("too much " + std::to_string(atoms_.size()));
  return id(form);
}

void NormalForms::bind(types::Slot slot, Form form) {
  // What was computed under another meaning of the local does not hold any more.
  if (locals_.contains(types::index(slot))) done_.clear();
  locals_.insert_or_assign(types::index(slot), std::move(form));
}

NormalForms::Form NormalForms::evaluate(const Expr& expr) {
  // Subtrees are shared: without this the work could double at every level.
  if (const auto found = done_.find(&expr); found != done_.end()) return found->second;
  if (++work_ > kMostWork) return {};
  Form form = compute(expr);
  if (expr.kind != ExprKind::Local) done_.insert_or_assign(&expr, form);
  return form;
}

NormalForms::Form NormalForms::compute(const Expr& expr) {
  const auto arg = [&](std::size_t k) -> const Expr& { return *expr.args.at(k); };
  const auto value = [](Sum sum) { return Form{Form::Kind::Number, std::move(sum), {}, {}}; };
  const auto at_orbit = [&](const char* what, const Expr& of, types::OrbitType type) {
    return what + text(type) + ":" + std::to_string(id(darts_.representative(dart(of), type)));
  };
  switch (expr.kind) {
    case ExprKind::Literal:
      if (expr.type.kind == ValueKind::Zero) return value({});
      if (types::is_scalar(expr.type) && expr.type.kind != ValueKind::Bool) {
        const double x = expr.value.as_real();
        return value(x == 0 ? Sum{} : Sum{{Product{}, x}});
      }
      return value(atom("literal " + types::to_string(expr.value), expr));
    case ExprKind::Local:
      return local(expr);
    case ExprKind::Let:
      bind(expr.slot, evaluate(arg(0)));
      return evaluate(arg(1));
    case ExprKind::Alpha:
      return {Form::Kind::Dart, {}, darts_.walk(dart(arg(0)), expr.number), {}};
    case ExprKind::Free:
      return value(atom("free" + std::to_string(expr.number) +
                            at_orbit(" ", arg(0), commuting_links(expr.number, links_.dimension())),
                        true));
    case ExprKind::SameDart:
      return value(symmetric("same dart", {&arg(0), &arg(1)}, true));
    case ExprKind::Embedding:
    case ExprKind::Has: {
      const std::string what = expr.kind == ExprKind::Has ? "has" : "read";
      const std::string which = what + std::to_string(types::index(expr.embedding)) + " ";
      return value(atom(at_orbit(which.c_str(), arg(0), schema_[expr.embedding].orbit), expr));
    }
    case ExprKind::Time:
      return value(atom("time", true));
    case ExprKind::Step:
      return value(atom("step", true));
    case ExprKind::Dt:
      return value(atom("dt", true));
    case ExprKind::Random: {
      const std::string seed = "random " + std::to_string(id(number(arg(0)))) + " ";
      return value(atom(at_orbit(seed.c_str(), arg(1), expr.orbit), true));
    }
    case ExprKind::OrbitDarts:
    case ExprKind::Quotient:
    case ExprKind::Polygon:
    case ExprKind::AllOrbits:
    case ExprKind::Range:
    case ExprKind::Forces:
      return {Form::Kind::Collection, {}, {}, collection(expr)};
    case ExprKind::ForceOn: {
      const std::string which =
          "force " + (expr.number == 1 ? std::to_string(types::index(expr.interaction)) : "all") +
          " ";
      return value(atom(at_orbit(which.c_str(), arg(0), expr.orbit), false));
    }
    case ExprKind::Fold:
      return fold(expr);
    case ExprKind::Neg:
      return value(multiply({{Product{}, -1.0}}, number(arg(0))));
    case ExprKind::Add:
    case ExprKind::Sub: {
      const double sign = expr.kind == ExprKind::Add ? 1.0 : -1.0;
      return value(plus(number(arg(0)), number(arg(1)), sign));
    }
    case ExprKind::Mul:
      return value(multiply(number(arg(0)), number(arg(1))));
    case ExprKind::Div:
      return value(quotient(number(arg(0)), number(arg(1))));
    case ExprKind::Pow:
      return value(power(expr));
    case ExprKind::Less:
    case ExprKind::LessEqual:
    case ExprKind::Greater:
    case ExprKind::GreaterEqual:
    case ExprKind::Equal:
    case ExprKind::NotEqual:
      return value(comparison(expr));
    case ExprKind::And:
      return value(symmetric("and", {&arg(0), &arg(1)}, true));
    case ExprKind::Or:
      return value(symmetric("or", {&arg(0), &arg(1)}, true));
    case ExprKind::Not:
      return value(atom("not " + std::to_string(id(number(arg(0)))), true));
    case ExprKind::If:
      return choice(expr);
    case ExprKind::Tuple:
    case ExprKind::Index: {
      std::string parts = expr.kind == ExprKind::Tuple ? "tuple" : "index";
      for (const types::ExprPtr& part : expr.args) parts += " " + std::to_string(id(number(*part)));
      return value(atom(parts, expr));
    }
    case ExprKind::Component:
      return value(component(expr));
    case ExprKind::Call:
      return value(call(expr));
    case ExprKind::Convert:
    case ExprKind::Frozen:
      return evaluate(arg(0));
    case ExprKind::Grad:
      return value(atom(
          "grad " + std::to_string(id(number(arg(0)))) + " " + std::to_string(id(number(arg(1)))),
          expr));
  }
  GMSIM_CHECK(false, "an expression of no kind");
  return {};
}

NormalForms::Form NormalForms::local(const Expr& expr) {
  const std::uint32_t slot = types::index(expr.slot);
  if (const auto bound = locals_.find(slot); bound != locals_.end()) return bound->second;
  if (const auto node = node_of_slot_.find(slot); node != node_of_slot_.end()) {
    const SymbolicDart dart = darts_.node(node->second);
    return {Form::Kind::Dart, {}, position_ ? darts_.from_next_row(dart, *position_) : dart, {}};
  }
  // A parameter: one value for the whole match.
  const std::string name = "local " + std::to_string(slot);
  if (expr.type.kind == ValueKind::Dart)
    return {Form::Kind::Dart, {}, darts_.other(static_cast<std::uint32_t>(intern(name))), {}};
  return {Form::Kind::Number, atom(name, expr), {}, {}};
}

NormalForms::Collection NormalForms::collection(const Expr& expr) {
  const auto at_orbit = [&](types::OrbitType type) {
    return std::to_string(id(darts_.representative(dart(*expr.args.at(0)), type)));
  };
  switch (expr.kind) {
    case ExprKind::OrbitDarts:
      return {"darts " + text(expr.orbit) + " " + at_orbit(expr.orbit)};
    case ExprKind::Quotient:
      return {"quotient " + text(expr.orbit) + " " + text(expr.orbit2) + " " +
              at_orbit(expr.orbit)};
    case ExprKind::Forces:
      return {"forces " + text(expr.orbit) + " " + at_orbit(expr.orbit)};
    case ExprKind::AllOrbits:
      return {"all " + text(expr.orbit)};
    case ExprKind::Range:
      return {"range " + std::to_string(id(number(*expr.args.at(0)))) + " " +
              std::to_string(id(number(*expr.args.at(1))))};
    case ExprKind::Polygon: {
      const auto [from, reversed] = darts_.around_face(dart(*expr.args.at(0)));
      return {"polygon " + std::to_string(id(from)), true, reversed};
    }
    default:
      return {"collection " + std::to_string(id(evaluate(expr)))};
  }
}

NormalForms::Form NormalForms::variable(ValueKind collection, const Word& walk) const {
  if (collection == ValueKind::Range || collection == ValueKind::Forces) {
    // Below the numbers of atoms, so that it needs no entry among them.
    const int number = -1 - static_cast<int>(open_folds_);
    const Product product =
        collection == ValueKind::Range ? Product{{number}, {}} : Product{{}, {number}};
    return {Form::Kind::Number, {{product, 1.0}}, {}, {}};
  }
  SymbolicDart dart = darts_.other(~open_folds_);
  for (const std::uint8_t i : walk) dart = darts_.walk(std::move(dart), i);
  return {Form::Kind::Dart, {}, std::move(dart), {}};
}

/// The body over the variable; around a face over the one of three neighbours from which it reads
/// what is nearest, since a sum around a face is the same from every corner.
Sum NormalForms::fold_body(const Expr& expr, const Collection& over) {
  const ValueKind kind = expr.args[0]->type.kind;
  std::vector<Word> walks{{}};
  if (over.around_face)
    walks = over.reversed ? std::vector<Word>{{0}, {1}, {0, 1, 0}}
                          : std::vector<Word>{{}, {0, 1}, {1, 0}};
  const std::size_t walked_before = walked_;
  Sum best;
  std::pair<std::size_t, int> least{};
  for (const Word& walk : walks) {
    walked_ = 0;
    bind(expr.slot, variable(kind, walk));
    ++open_folds_;
    Sum body = number(*expr.args[1]);
    --open_folds_;
    const std::pair<std::size_t, int> cost{walked_, id(body)};
    if (&walk != &walks.front() && cost >= least) continue;
    least = cost;
    best = std::move(body);
  }
  walked_ = walked_before + least.first;
  return best;
}

NormalForms::Form NormalForms::fold(const Expr& expr) {
  Collection over = evaluate(*expr.args.at(0)).collection;
  const bool picks = expr.fold == FoldKind::ArgMax || expr.fold == FoldKind::ArgMin;
  // Ties go to the first, and where a polygon begins depends on the dart that names it.
  if (picks && expr.args[0]->kind == ExprKind::Polygon)
    over = {"polygon from " + std::to_string(id(dart(*expr.args[0]->args.at(0))))};
  const std::string head = "fold " + std::to_string(static_cast<int>(expr.fold)) + " " +
                           std::to_string(open_folds_) + " " + std::to_string(intern(over.key)) +
                           " ";
  if (expr.args.size() == 1) return {Form::Kind::Number, atom(head, expr), {}, {}};
  const Sum body = fold_body(expr, over);
  if (picks) {
    ++open_folds_;
    const int result = id(evaluate(*expr.args.at(2)));
    --open_folds_;
    const std::string key = head + std::to_string(id(body)) + " " + std::to_string(result);
    if (expr.type.kind == ValueKind::Dart)
      return {Form::Kind::Dart, {}, darts_.other(static_cast<std::uint32_t>(intern(key))), {}};
    return {Form::Kind::Number, atom(key, expr), {}, {}};
  }
  if (expr.fold != FoldKind::Sum && expr.fold != FoldKind::Mean)
    return {Form::Kind::Number, atom(head + std::to_string(id(body)), expr), {}, {}};
  Sum total;
  for (const auto& [product, factor] : body)
    total = plus(total, atom(head + std::to_string(id(Sum{{product, 1.0}})), expr), factor);
  return {Form::Kind::Number, std::move(total), {}, {}};
}

NormalForms::Form NormalForms::choice(const Expr& expr) {
  const Form yes = evaluate(*expr.args.at(1)), no = evaluate(*expr.args.at(2));
  if (yes.kind != no.kind) return {};
  if (id(yes) == id(no)) return yes;
  const std::string key = "if " + std::to_string(id(number(*expr.args.at(0)))) + " " +
                          std::to_string(id(yes)) + " " + std::to_string(id(no));
  if (yes.kind == Form::Kind::Dart)
    return {Form::Kind::Dart, {}, darts_.other(static_cast<std::uint32_t>(intern(key))), {}};
  if (yes.kind == Form::Kind::Collection) return {Form::Kind::Collection, {}, {}, {key}};
  return {Form::Kind::Number, atom(key, expr), {}, {}};
}

int NormalForms::intern(const std::string& key) {
  return atoms_.emplace(key, static_cast<int>(atoms_.size())).first->second;
}

int NormalForms::id(const SymbolicDart& dart) {
  if (!dart.of_match) walked_ += dart.walk.size();
  std::string key = (dart.of_match ? "dart " : "other ") + std::to_string(dart.base) + " ";
  for (const std::uint8_t position : dart.rows) key += static_cast<char>('0' + position);
  key += "@";
  for (const std::uint8_t dimension : dart.walk) key += static_cast<char>('0' + dimension);
  return intern(key);
}

int NormalForms::id(const Form& form) {
  switch (form.kind) {
    case Form::Kind::Number:
      return id(form.sum);
    case Form::Kind::Dart:
      return id(form.dart);
    case Form::Kind::Collection:
      return intern(form.collection.key + (form.collection.reversed ? " reversed" : ""));
  }
  return 0;
}

Sum NormalForms::atom(const std::string& key, bool scalar) {
  const int number = intern(key);
  return {{scalar ? Product{{number}, {}} : Product{{}, {number}}, 1.0}};
}

Sum NormalForms::atom(const std::string& key, const Expr& expr) {
  return atom(key, types::is_scalar(expr.type));
}

}  // namespace gmsim::check
