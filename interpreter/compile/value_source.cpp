// SPDX-License-Identifier: MIT
#include "compile/value_source.h"

#include <algorithm>
#include <functional>

namespace gmsim::compile {

using types::Expr;
using types::ExprKind;

ValueSource ValueSource::uniform(std::vector<double> value) {
  ValueSource source;
  source.kind = Kind::Constant;
  source.constant = std::move(value);
  return source;
}

ValueSource ValueSource::expression(ExprPtr expr, Frame frame, Slot dart,
                                    std::uint32_t frame_size) {
  ValueSource source;
  source.kind = Kind::Expression;
  source.expr = std::move(expr);
  source.frame = frame;
  source.dart = dart;
  source.frame_size = frame_size;
  return source;
}

ValueSource ValueSource::missing() {
  ValueSource source;
  source.kind = Kind::Missing;
  return source;
}

const ValueSource* ValueSources::find_parameter(Slot slot) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const auto& entry) { return entry.first == slot; });
  return found == parameters.end() ? nullptr : &found->second;
}

ValueSources stored_sources(const gmap::EmbeddingSchema& schema,
                            const gmap::EmbeddingStore& store) {
  ValueSources sources;
  for (std::uint32_t i = 0; i < schema.size(); ++i) {
    const EmbeddingId id{i};
    const gmap::EmbeddingDecl& decl = schema[id];
    if (decl.derivation) {
      sources.embeddings.push_back(ValueSource::expression(
          decl.derivation, ValueSource::Frame::SmallestDart, decl.dart_slot, decl.frame_size));
    } else if (store.in_use(id)) {
      sources.embeddings.push_back(ValueSource::gathered());
    } else if (decl.default_value) {
      sources.embeddings.push_back(ValueSource::uniform(decl.default_value->data));
    } else {
      sources.embeddings.push_back(ValueSource::missing());
    }
  }
  return sources;
}

namespace {

/// Does the expression read a value that `moves`, the clock, or a force?
bool reads_motion(const Expr& expr, const std::function<bool(EmbeddingId)>& moves) {
  switch (expr.kind) {
    case ExprKind::Time:
    case ExprKind::Step:
    case ExprKind::Dt:
    case ExprKind::Forces:
    case ExprKind::ForceOn:
      return true;
    case ExprKind::Embedding:
      if (moves(expr.embedding)) return true;
      break;
    default:
      break;
  }
  return std::any_of(expr.args.begin(), expr.args.end(), [&](const ExprPtr& argument) {
    return argument && reads_motion(*argument, moves);
  });
}

}  // namespace

std::vector<bool> values_in_motion(const gmap::EmbeddingSchema& schema,
                                   const std::vector<EmbeddingId>& moving) {
  std::vector<bool> in_motion(schema.size(), false);
  for (const EmbeddingId id : moving) in_motion[types::index(id)] = true;
  const auto moves = [&](EmbeddingId id) { return bool{in_motion[types::index(id)]}; };
  // Derived values may read derived values declared after them: again until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = 0; i < schema.size(); ++i) {
      const gmap::EmbeddingDecl& decl = schema[EmbeddingId{i}];
      if (in_motion[i] || !decl.derivation || !reads_motion(*decl.derivation, moves)) continue;
      in_motion[i] = changed = true;
    }
  }
  return in_motion;
}

}  // namespace gmsim::compile
