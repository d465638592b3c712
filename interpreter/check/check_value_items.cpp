// SPDX-License-Identifier: MIT
// Embeddings and derived values.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "check/check_expr.h"
#include "check/item_checks.h"
#include "check/value_kinds.h"

namespace gmsim::check {
using gmap::EmbeddingDecl;
using gmap::EmbeddingKind;
using support::DiagnosticKind;
namespace {

void declare_type(ItemContext& context, const syntax::TypeExpr& type,
                  const syntax::OrbitExpr& orbit, EmbeddingDecl& value) {
  if (const auto resolved = resolve_type(context, type)) {
    value.type = resolved->type;
    value.unit = resolved->unit;
    value.unit_scale = resolved->scale;
  } else {
    context.poison();
  }
  if (const auto resolved = resolve_orbit(context, orbit)) value.orbit = *resolved;
}

Wanted wanted_by(const EmbeddingDecl& value) {
  return {.type = value.type, .unit = value.unit, .scale = value.unit_scale,
          .what = "`" + value.name + "`"};
}

}  // namespace

EmbeddingDecl declare_value(ItemContext& context, const ItemEntry& entry) {
  EmbeddingDecl value;
  value.name = entry.name->text;
  value.doc = entry.item->doc;
  value.span = entry.name->span;
  if (const auto* item = std::get_if<syntax::EmbeddingItem>(&entry.item->node)) {
    declare_type(context, item->type, item->orbit, value);
    value.optional = item->optional;
    const ValueBehaviour behaviour = resolve_behaviour(
        context, item->kind, item->merge, {value.type, value.unit, value.unit_scale});
    value.kind = behaviour.kind;
    value.merge = behaviour.merge;
  }
  if (const auto* item = std::get_if<syntax::DerivedItem>(&entry.item->node)) {
    declare_type(context, item->type, item->orbit, value);
    value.kind = EmbeddingKind::Derived;
  }
  return value;
}

void complete_value(ItemContext& context, const ItemEntry& entry, EmbeddingDecl& value) {
  ExprChecker checker(context);
  if (const auto* item = std::get_if<syntax::DerivedItem>(&entry.item->node)) {
    value.dart_slot =
        context.declare_slot(item->dart, Binding::Kind::Node, {ValueKind::Dart})->slot;
    value.derivation = checker.check_as(item->value, wanted_by(value));
    value.frame_size = static_cast<std::uint32_t>(context.slot_names.size());
    return;
  }
  const auto& item = std::get<syntax::EmbeddingItem>(entry.item->node);
  check_weight(context.env, context.sources, item.kind, {"a", entry.name->span}, value, context);
  if (!item.default_value) return;
  const ExprPtr written = checker.check_as(item.default_value, wanted_by(value));
  if (is_error(written)) return;
  value.default_value = constant_value(*written);
  if (!value.default_value)
    context.report({.kind = DiagnosticKind::NotConstant,
                    .message = "the default of an embedding must be a constant",
                    .place = item.default_value->span,
                    .help = "rules that create its orbit can give computed values"});
}

std::vector<EmbeddingId> find_derived_cycles(const gmap::EmbeddingSchema& schema,
                                             support::Diagnostics& diagnostics) {
  // What each derived value reads of the derived values, with a place.
  std::map<EmbeddingId, std::map<EmbeddingId, Span>> reads;
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const EmbeddingId id{static_cast<std::uint32_t>(i)};
    for_each_node(schema[id].derivation, [&](const types::Expr& node) {
      if (node.kind == ExprKind::Embedding && schema[node.embedding].derivation)
        reads[id].emplace(node.embedding, node.span);
    });
  }
  std::vector<EmbeddingId> in_cycle;
  for (const auto& [start, direct] : reads) {
    if (std::ranges::count(in_cycle, start) > 0) continue;
    // Everything reachable from `start`; a way back closes a cycle.
    std::map<EmbeddingId, EmbeddingId> reached_from;
    std::vector<EmbeddingId> open = {start};
    while (!open.empty() && !reached_from.contains(start)) {
      const EmbeddingId at = open.back();
      open.pop_back();
      for (const auto& [next, place] : reads[at])
        if (reached_from.emplace(next, at).second) open.push_back(next);
    }
    if (!reached_from.contains(start)) continue;
    std::vector<EmbeddingId> cycle;
    EmbeddingId at = start;
    do {
      cycle.push_back(at);
      at = reached_from.at(at);
    } while (at != start);
    std::string way = "`" + schema[start].name + "`";
    for (std::size_t i = cycle.size(); i-- > 1;) way += " reads `" + schema[cycle[i]].name + "`, which";
    const bool direct_cycle = cycle.size() == 1;
    way += direct_cycle ? " reads itself" : " reads `" + schema[start].name + "`";
    const EmbeddingId next = direct_cycle ? start : cycle.back();
    diagnostics.report({.kind = DiagnosticKind::RecursiveDefinition,
                        .message = "derived values in a circle: " + way,
                        .place = reads[start].at(next),
                        .related = {{schema[start].span, "declared here"}}});
    in_cycle.insert(in_cycle.end(), cycle.begin(), cycle.end());
  }
  return in_cycle;
}

}  // namespace gmsim::check
