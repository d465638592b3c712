// SPDX-License-Identifier: MIT
#include "engine/tree_walker.h"

#include <fmt/format.h>

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::ValueKind;

double random_number(std::int64_t seed, const State& state, OrbitType type, DartId dart) {
  // SplitMix64 (Steele, Lea, Flood 2014), one round for each part of the key.
  std::uint64_t hash = 0;
  const std::uint64_t key[] = {static_cast<std::uint64_t>(seed), state.seed, type.bits(),
                               types::index(gmap::smallest_dart(state.map, type, dart))};
  for (const std::uint64_t part : key) {
    hash = (hash ^ part) + 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  }
  return static_cast<double>(hash >> 11) * 0x1p-53;
}

// ---- failures -----------------------------------------------------------------------------------

void TreeWalker::fail(DiagnosticKind kind, const Expr& where, std::string message,
                      std::string help) {
  if (failed()) return;
  support::Diagnostic diagnostic{kind, std::move(message), where.span};
  diagnostic.help = std::move(help);
  failure_ = EvalFailure{false, std::move(diagnostic)};
}

void TreeWalker::fail_missing(EmbeddingId id, DartId dart, const Expr* reader) {
  if (failed()) return;
  const gmap::EmbeddingDecl& decl = state_.program.schema[id];
  support::Diagnostic diagnostic{
      DiagnosticKind::MissingEmbeddingValue,
      fmt::format("`{}` has no value at the {} orbit of dart {}", decl.name,
                  types::to_string(decl.orbit), types::index(dart))};
  if (reader != nullptr) diagnostic.place = reader->span;
  if (decl.optional) diagnostic.help = fmt::format("test with `has(a.{})` first", decl.name);
  failure_ = EvalFailure{decl.optional, std::move(diagnostic)};
}

void TreeWalker::unavailable(const Expr& expr) {
  const bool derivative = expr.kind == ExprKind::Grad;
  fail(DiagnosticKind::NotAvailable, expr,
       derivative ? "derivatives cannot be taken here" : "forces cannot be read here",
       derivative ? "`grad` works in interactions and criteria"
                  : "criteria, output fields and expectations read them while a scene runs");
}

EvalFailure TreeWalker::take_failure() {
  GMSIM_CHECK(failed(), "there is no failure to take");
  EvalFailure failure = std::move(*failure_);
  failure_.reset();
  return failure;
}

// ---- darts --------------------------------------------------------------------------------------

bool TreeWalker::live_dart(const Expr& expr, DartId& out) {
  out = dart(expr);
  if (state_.map.alive(out)) return true;
  fail(DiagnosticKind::NoMatch, expr,
       fmt::format("dart {} is no longer part of the map", types::index(out)));
  return false;
}

DartId TreeWalker::dart(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Local:
      return frame_->dart(expr.slot);
    case ExprKind::Literal:
      return expr.value.dart;
    case ExprKind::Alpha: {
      DartId from;
      return live_dart(*expr.args[0], from) ? state_.map.alpha(expr.number, from) : from;
    }
    case ExprKind::Let: {
      DartId result = types::kNoDart;
      with_bound(expr, [&] { result = dart(*expr.args[1]); });
      return result;
    }
    case ExprKind::If:
      return dart(branch(expr));
    case ExprKind::Fold:
      return fold_dart(expr);
    default:
      support::internal_error(__FILE__, __LINE__, "expression has no dart");
  }
}

const Expr& TreeWalker::branch(const Expr& choice) {
  return truth(*choice.args[0]) ? *choice.args[1] : *choice.args[2];
}

// ---- values -------------------------------------------------------------------------------------

void TreeWalker::derived(EmbeddingId id, DartId dart, double* out) {
  const gmap::EmbeddingDecl& decl = state_.program.schema[id];
  if (derived_depth_ == derived_frames_.size()) derived_frames_.emplace_back();
  Frame& frame = derived_frames_[derived_depth_++];
  frame.reset(decl.frame_size);
  // At the smallest dart, so that the last bit does not depend on which dart asks.
  frame.set(decl.dart_slot, gmap::smallest_dart(state_.map, decl.orbit, dart));
  const Entry entry(*this, frame);
  numbers(*decl.derivation, out);
  --derived_depth_;
}

void TreeWalker::read(EmbeddingId id, DartId dart, double* out, const Expr* reader) {
  const gmap::EmbeddingDecl& decl = state_.program.schema[id];
  if (decl.kind == gmap::EmbeddingKind::Derived && decl.derivation) return derived(id, dart, out);
  std::span<const double> value = stored_.at(id, dart);
  if (value.empty() && !stored_.in_use(id) && decl.default_value) {
    value = decl.default_value->data;
  }
  if (!value.empty()) {
    std::copy(value.begin(), value.end(), out);
    return;
  }
  fail_missing(id, dart, reader);
  std::fill_n(out, types::number_count(decl.type), 0.0);
}

bool TreeWalker::has(const Expr& expr) {
  DartId at;
  if (!live_dart(*expr.args[0], at)) return false;
  const gmap::EmbeddingDecl& decl = state_.program.schema[expr.embedding];
  if (decl.kind == gmap::EmbeddingKind::Derived) return decl.derivation != nullptr;
  if (!state_.store.in_use(expr.embedding)) return decl.default_value.has_value();
  const std::span<const double> value = stored_.at(expr.embedding, at);
  if (value.empty()) return false;
  return decl.role != gmap::EmbeddingRole::Presence || value[0] != 0.0;
}

const double* TreeWalker::view(const Expr& expr, double* scratch) {
  switch (expr.kind) {
    case ExprKind::Literal:
      if (!expr.value.data.empty()) return expr.value.data.data();
      break;
    case ExprKind::Local:
      return frame_->numbers(expr.slot).data();
    case ExprKind::Frozen:
      return view(*expr.args[0], scratch);
    case ExprKind::Embedding: {
      DartId at;
      if (!live_dart(*expr.args[0], at)) break;
      const std::span<const double> value = stored_.at(expr.embedding, at);
      if (!value.empty()) return value.data();
      break;
    }
    default:
      break;
  }
  numbers(expr, scratch);
  return scratch;
}

std::uint32_t TreeWalker::element_offset(const Expr& index) {
  const double position = scalar(*index.args[1]);
  const std::uint32_t extent = index.args[0]->type.extents.front();
  if (position < 0.0 || position >= extent) {
    fail(DiagnosticKind::BadIndex, *index.args[1],
         fmt::format("index {} is outside of 0..{}", types::number_text(position), extent));
    return 0;
  }
  return static_cast<std::uint32_t>(position) * types::number_count(index.type);
}

void TreeWalker::assign(const Expr& expr, Slot slot) {
  switch (expr.type.kind) {
    case ValueKind::Dart:
      return frame_->set(slot, dart(expr));
    case ValueKind::Darts: {
      std::vector<DartId> all;
      darts(expr, all);
      return frame_->set(slot, std::move(all));
    }
    default: {
      const Arena::Mark mark = frame_->arena_.mark();
      const std::uint32_t count = types::number_count(expr.type);
      double* value = frame_->arena_.allocate(count);
      numbers(expr, value);
      Frame::Cell& cell = frame_->use(slot);
      const bool fits = cell.numbers != nullptr && cell.count == count;
      if (!fits) {
        cell.numbers = value;
        cell.count = count;
      } else {
        std::copy_n(value, count, cell.numbers);
        frame_->arena_.release(mark);
      }
      cell.kind = Frame::Kind::Numbers;
    }
  }
}

double TreeWalker::scalar(const Expr& expr) {
  DartId a, b;
  switch (expr.kind) {
    case ExprKind::Literal:
      return expr.value.data.empty() ? 0.0 : expr.value.data[0];
    case ExprKind::Local:
      return frame_->numbers(expr.slot)[0];
    case ExprKind::Free:
      return live_dart(*expr.args[0], a) && state_.map.is_free(expr.number, a) ? 1.0 : 0.0;
    case ExprKind::SameDart:
      a = dart(*expr.args[0]);
      b = dart(*expr.args[1]);
      return a == b ? 1.0 : 0.0;
    case ExprKind::Has:
      return has(expr) ? 1.0 : 0.0;
    case ExprKind::Time:
      return state_.time;
    case ExprKind::Step:
      return static_cast<double>(state_.step);
    case ExprKind::Dt:
      return state_.dt;
    case ExprKind::Random: {
      const double seed = scalar(*expr.args[0]);
      if (!live_dart(*expr.args[1], a)) return 0.0;
      return random_number(static_cast<std::int64_t>(seed), state_, expr.orbit, a);
    }
    case ExprKind::And:
      return truth(*expr.args[0]) && truth(*expr.args[1]) ? 1.0 : 0.0;
    case ExprKind::Or:
      return truth(*expr.args[0]) || truth(*expr.args[1]) ? 1.0 : 0.0;
    case ExprKind::Not:
      return truth(*expr.args[0]) ? 0.0 : 1.0;
    case ExprKind::If:
      return scalar(branch(expr));
    case ExprKind::Component: {
      double scratch[4];
      return view(*expr.args[0], scratch)[expr.number];
    }
    case ExprKind::Neg:
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
      return scalar_arithmetic(expr);
    default: {
      double result = 0.0;
      numbers(expr, &result);
      return result;
    }
  }
}

void TreeWalker::numbers(const Expr& expr, double* out) {
  switch (expr.kind) {
    case ExprKind::Local: {
      const std::span<const double> value = frame_->numbers(expr.slot);
      std::copy(value.begin(), value.end(), out);
      return;
    }
    case ExprKind::Let:
      return with_bound(expr, [&] { numbers(*expr.args[1], out); });
    case ExprKind::Embedding: {
      DartId at;
      if (live_dart(*expr.args[0], at)) return read(expr.embedding, at, out, &expr);
      std::fill_n(out, types::number_count(expr.type), 0.0);
      return;
    }
    case ExprKind::If:
      return numbers(branch(expr), out);
    case ExprKind::Frozen:
      return numbers(*expr.args[0], out);
    case ExprKind::Fold:
      return fold(expr, out);
    case ExprKind::Convert:
      return convert(expr, out);
    case ExprKind::Call:
      return call(expr, out);
    case ExprKind::Range:
    case ExprKind::Tuple:
      for (std::size_t i = 0; i < expr.args.size(); ++i) out[i] = scalar(*expr.args[i]);
      return;
    case ExprKind::Component: {
      double scratch[4];
      const double* pair = view(*expr.args[0], scratch);  // a vector's components are scalars
      if (types::is_scalar(expr.type)) {
        *out = pair[expr.number];
      } else {
        std::copy_n(pair + 1, 3, out);
      }
      return;
    }
    case ExprKind::Index: {
      const Arena::Mark mark = frame_->arena_.mark();
      double* scratch = frame_->arena_.allocate(types::number_count(expr.args[0]->type));
      const double* element = view(*expr.args[0], scratch) + element_offset(expr);
      std::copy_n(element, types::number_count(expr.type), out);
      frame_->arena_.release(mark);
      return;
    }
    case ExprKind::Literal:
      if (!types::is_scalar(expr.type)) {
        std::copy(expr.value.data.begin(), expr.value.data.end(), out);
        return;
      }
      *out = scalar(expr);
      return;
    case ExprKind::Neg:
    case ExprKind::Add:
    case ExprKind::Sub:
    case ExprKind::Mul:
    case ExprKind::Div:
    case ExprKind::Pow:
      if (!types::is_scalar(expr.type)) return arithmetic(expr, out);
      *out = scalar(expr);
      return;
    case ExprKind::Free:
    case ExprKind::SameDart:
    case ExprKind::Has:
    case ExprKind::Time:
    case ExprKind::Step:
    case ExprKind::Dt:
    case ExprKind::Random:
    case ExprKind::Less:
    case ExprKind::LessEqual:
    case ExprKind::Greater:
    case ExprKind::GreaterEqual:
    case ExprKind::Equal:
    case ExprKind::NotEqual:
    case ExprKind::And:
    case ExprKind::Or:
    case ExprKind::Not:
      *out = scalar(expr);
      return;
    case ExprKind::ForceOn:
      return force_on(expr, out);
    case ExprKind::Forces:
    case ExprKind::Grad:
      unavailable(expr);
      std::fill_n(out, types::number_count(expr.type), 0.0);
      return;
    case ExprKind::Alpha:
    case ExprKind::OrbitDarts:
    case ExprKind::Quotient:
    case ExprKind::Polygon:
    case ExprKind::AllOrbits:
      support::internal_error(__FILE__, __LINE__, "expression has no numbers");
  }
}

}  // namespace gmsim::engine
