// SPDX-License-Identifier: MIT
#include "check/dimension_checker.h"

#include <algorithm>
#include <utility>

#include "check/build_pattern.h"
#include "check/check_expr.h"
#include "check/passes.h"
#include "check/resolve.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;

const std::vector<DimensionChecker::Pass>& DimensionChecker::passes() {
  static const std::vector<Pass> list = {
      {"check.dimensions", &DimensionChecker::mark_other_dimensions},
      {"check.orbits", &DimensionChecker::check_orbits},
      {"check.patterns", &DimensionChecker::check_patterns},
      {"check.values", &DimensionChecker::check_values},
      {"check.functions", &DimensionChecker::check_functions},
      {"check.rules", &DimensionChecker::check_rules},
      {"check.operations", &DimensionChecker::check_operations},
      {"check.criteria", &DimensionChecker::check_criteria}};
  return list;
}

void DimensionChecker::run() {
  for (const Pass& pass : passes()) (this->*pass.run)();
}

// ---- bookkeeping --------------------------------------------------------------------------------

std::vector<ItemIndex> DimensionChecker::unchecked(ItemKind kind) const {
  // The library's texts go on using its functions and patterns when a user replaces them.
  const bool expanded = kind == ItemKind::Function || kind == ItemKind::Pattern;
  std::vector<ItemIndex> items;
  for (ItemIndex i = 0; i < env_.states.size(); ++i)
    if ((*env_.items)[i].kind == kind && env_.states[i].status == ItemStatus::Unchecked &&
        (expanded || env_.items->active(i, env_.dimension)))
      items.push_back(i);
  return items;
}

ItemContext DimensionChecker::context_for(ItemIndex item) const {
  ItemContext context(env_, sources_);
  context.in_library = (*env_.items)[item].library;
  return context;
}

void DimensionChecker::keep(ItemIndex item, ItemContext& context) {
  ItemState& state = env_.states[item];
  state.absence = context.absence;
  state.diagnostics = std::move(context.diagnostics);
  state.status = state.absence                         ? ItemStatus::Absent
                 : context.poisoned || state.diagnostics.has_errors() ? ItemStatus::Failed
                                                                      : ItemStatus::Present;
  if (state.status == ItemStatus::Failed && (*env_.items)[item].library) leave_unfitting(item);
}

/// Where a user's value has taken the place of one of the library's, library items that do not fit
/// it are no mistake of the user: they are absent.
void DimensionChecker::leave_unfitting(ItemIndex item) {
  const auto is_value = [](ItemKind kind) {
    return kind == ItemKind::Embedding || kind == ItemKind::Derived ||
           kind == ItemKind::Interaction || kind == ItemKind::Family;
  };
  for (ItemIndex i = 0; i < env_.states.size(); ++i) {
    const ItemEntry& entry = (*env_.items)[i];
    if (!entry.library || !is_value(entry.kind) || env_.items->active(i, env_.dimension)) continue;
    ItemState& state = env_.states[item];
    state.status = ItemStatus::Absent;
    state.diagnostics = {};
    state.absence = support::Diagnostic{
        .kind = DiagnosticKind::Shadowing,
        .message = "it does not fit the `" + entry.name->text +
                   "` that takes the place of the library's",
        .place = (*env_.items)[item].name->span};
    return;
  }
}

void DimensionChecker::mark_other_dimensions() {
  for (ItemIndex i = 0; i < env_.states.size(); ++i) {
    const ItemEntry& entry = (*env_.items)[i];
    if (!entry.dimension || *entry.dimension == env_.dimension) continue;
    env_.states[i].status = ItemStatus::Absent;
    env_.states[i].absence = support::Diagnostic{
        .kind = DiagnosticKind::Dimension,
        .message = "it says `dimension " + std::to_string(*entry.dimension) + ";`",
        .place = entry.name->span};
  }
}

// ---- orbits, patterns, functions ----------------------------------------------------------------

void DimensionChecker::check_orbits() {
  RuleLibrary& library = *env_.library;
  library.orbits = predeclared_orbits(env_.dimension);
  for (const ItemIndex i : unchecked(ItemKind::Orbit)) {
    const ItemEntry& entry = (*env_.items)[i];
    const auto& item = std::get<syntax::OrbitItem>(entry.item->node);
    ItemContext context = context_for(i);
    const auto orbit = resolve_orbit(context, item.orbit);
    const auto known = library.find_orbit(item.name.text);
    if (orbit && known && *known != *orbit)
      context.report({.kind = DiagnosticKind::Conflict,
                      .message = "`" + item.name.text + "` is predeclared as " +
                                 to_string(*known) + ", this is " + to_string(*orbit),
                      .place = item.orbit.span});
    if (orbit && !known) library.orbits.push_back({item.name.text, *orbit, entry.item->doc});
    keep(i, context);
  }
}

void DimensionChecker::check_patterns() {
  for (const ItemIndex i : unchecked(ItemKind::Pattern)) check_pattern(env_, i, sources_);
}

void DimensionChecker::check_functions() {
  for (const ItemIndex i : unchecked(ItemKind::Function)) check_function(env_, i, sources_);
}

// ---- embeddings, derived values, interactions, families -----------------------------------------

/// Values may read each other, so all are declared before any is looked into. One that turns out to be
/// absent or wrong on the second look leaves, and the round is repeated without it.
void DimensionChecker::check_values() {
  for (;;) {
    declare_values();
    declare_families();
    complete_values();
    if (round_is_final()) break;
    reset_values();
  }
  for (std::unique_ptr<InteractionDraft>& draft : drafts_) {
    env_.states[draft->item].status = ItemStatus::Present;
    draft->result.footprint = footprint(draft->result);
    env_.library->interactions[types::index(draft->result.id)] = draft->result;
  }
}

void DimensionChecker::declare_values() {
  RuleLibrary& library = *env_.library;
  for (const ItemKind kind : {ItemKind::Embedding, ItemKind::Derived})
    for (const ItemIndex i : unchecked(kind)) {
      ItemContext context = context_for(i);
      gmap::EmbeddingDecl value = declare_value(context, (*env_.items)[i]);
      if (!context.good()) {
        keep(i, context);
        continue;
      }
      const std::string name = value.name;
      const EmbeddingId id = library.schema.add(std::move(value));
      env_.values[name] = id;
      declared_.emplace_back(i, id);
    }
  for (const ItemIndex i : unchecked(ItemKind::Interaction)) {
    auto draft = std::make_unique<InteractionDraft>(i, env_, sources_);
    draft->context.in_library = (*env_.items)[i].library;
    declare_interaction(*draft);
    if (!draft->context.good()) {
      keep(i, draft->context);
      continue;
    }
    draft->result.id = InteractionId{static_cast<std::uint32_t>(library.interactions.size())};
    library.interactions.push_back(draft->result);
    env_.values[draft->result.name] = draft->result.id;
    first_values_.push_back(EmbeddingId{static_cast<std::uint32_t>(library.schema.size())});
    for (gmap::EmbeddingDecl& value : draft->values) library.schema.add(std::move(value));
    drafts_.push_back(std::move(draft));
  }
}

void DimensionChecker::declare_families() {
  for (const ItemIndex i : unchecked(ItemKind::Family)) {
    ItemContext context = context_for(i);
    Family family = check_family(context, (*env_.items)[i]);
    const bool good = context.good();
    keep(i, context);
    if (!good) continue;
    env_.values[family.name] = FamilyIndex{static_cast<std::uint32_t>(env_.library->families.size())};
    env_.library->families.push_back(std::move(family));
  }
}

void DimensionChecker::complete_values() {
  gmap::EmbeddingSchema& schema = env_.library->schema;
  for (const auto& [item, id] : declared_) {
    ItemContext context = context_for(item);
    complete_value(context, (*env_.items)[item], schema[id]);
    keep(item, context);
  }
  support::Diagnostics cycles;
  const std::vector<EmbeddingId> in_cycle = find_derived_cycles(schema, cycles);
  for (const auto& [item, id] : declared_) {
    if (std::ranges::count(in_cycle, id) == 0) continue;
    env_.states[item].status = ItemStatus::Failed;
    for (const support::Diagnostic& diagnostic : cycles.all())
      if (diagnostic.related.front().span == schema[id].span)
        env_.states[item].diagnostics.report(diagnostic);
  }
  for (std::size_t i = 0; i < drafts_.size(); ++i) {
    if (!in_cycle.empty()) break;  // what reads a value in a circle could not be followed
    complete_interaction(*drafts_[i], first_values_[i]);
    if (!drafts_[i]->context.good()) keep(drafts_[i]->item, drafts_[i]->context);
  }
}

bool DimensionChecker::round_is_final() const {
  const auto gone = [&](ItemIndex item) {
    const ItemStatus status = env_.states[item].status;
    return status == ItemStatus::Absent || status == ItemStatus::Failed;
  };
  return std::ranges::none_of(declared_, [&](const auto& value) { return gone(value.first); }) &&
         std::ranges::none_of(drafts_, [&](const auto& draft) { return gone(draft->item); });
}

void DimensionChecker::reset_values() {
  for (ItemIndex i = 0; i < env_.states.size(); ++i) {
    const ItemKind kind = (*env_.items)[i].kind;
    const bool value = kind == ItemKind::Embedding || kind == ItemKind::Derived ||
                       kind == ItemKind::Function;
    const bool family = kind == ItemKind::Family;
    ItemState& state = env_.states[i];
    const bool other_dimension = (*env_.items)[i].dimension.value_or(env_.dimension) != env_.dimension;
    if (other_dimension) continue;
    if ((value && state.status == ItemStatus::Present) || family || kind == ItemKind::Function)
      state = ItemState{};
  }
  env_.values.clear();
  env_.functions.clear();
  env_.library->schema = {};
  env_.library->interactions.clear();
  env_.library->families.clear();
  drafts_.clear();
  first_values_.clear();
  declared_.clear();
}

// ---- rules, criteria, operations ----------------------------------------------------------------

void DimensionChecker::check_rules() {
  for (const ItemIndex i : unchecked(ItemKind::Rule)) {
    const ItemEntry& entry = (*env_.items)[i];
    ItemContext context = context_for(i);
    Rule rule = check_rule(context, entry);
    const bool makes_sense = context.good() && is_well_formed(rule);
    if (context.good() && check_topology(rule, context.diagnostics))
      check_rule_embeddings(rule, entry, files_, env_.library->schema, context.diagnostics);
    const bool good = context.good();
    keep(i, context);
    if (!good && !(env_.keep_rejected && makes_sense)) continue;
    rule.footprint = footprint(rule);
    env_.library->rules.push_back(std::move(rule));
  }
}

const InteractionDraft* DimensionChecker::draft_of(const syntax::Name& name,
                                                   ItemContext& context) {
  const ItemTable& items = *env_.items;
  if (const auto item = items.find(NameSpace::Values, name.text, env_.dimension)) {
    if (!context.require(*item, name.span)) return nullptr;
    for (const auto& draft : drafts_)
      if (draft->item == *item) return draft.get();
  }
  const auto other = items.find_any(NameSpace::Values, name.text);
  if (other && items[*other].kind == ItemKind::Interaction) {
    context.absent(DiagnosticKind::Dimension, name.span,
                   "interaction `" + name.text + "` does not exist in dimension " +
                       std::to_string(env_.dimension));
    return nullptr;
  }
  context.report_unknown(
      {.kind = DiagnosticKind::UnknownItem,
       .message = other ? "`" + name.text + "` is " + with_article(items[*other].kind) +
                              ", not an interaction"
                        : "no interaction named `" + name.text + "`",
       .place = name.span,
       .help = other ? "" : support::did_you_mean(name.text, items.names(NameSpace::Values))});
  return nullptr;
}

void DimensionChecker::check_criteria() {
  for (const ItemIndex i : unchecked(ItemKind::Criterion)) {
    const ItemEntry& entry = (*env_.items)[i];
    const auto& item = std::get<syntax::CriterionItem>(entry.item->node);
    ItemContext context = context_for(i);
    const InteractionDraft* of = item.interaction ? draft_of(*item.interaction, context) : nullptr;
    if (item.interaction && !of) {
      keep(i, context);
      continue;
    }
    Criterion criterion = check_criterion(context, entry, of);
    const bool good = context.good();
    keep(i, context);
    if (!good) continue;
    criterion.footprint = footprint(criterion);
    env_.library->criteria.push_back(std::move(criterion));
  }
}

void DimensionChecker::check_operations() {
  for (const ItemIndex i : unchecked(ItemKind::Operation)) check_operation_after_its_parts(i, 0);
}

void DimensionChecker::check_operation_after_its_parts(ItemIndex i, int depth) {
  if (env_.states[i].status != ItemStatus::Unchecked || depth >= kDeepestDefinition) return;
  const ItemEntry& entry = (*env_.items)[i];
  env_.states[i].status = ItemStatus::InProgress;
  for (const syntax::Name* name :
       applied_names(std::get<syntax::OperationItem>(entry.item->node)))
    if (const auto part = env_.items->find(NameSpace::Operations, name->text, env_.dimension))
      check_operation_after_its_parts(*part, depth + 1);
  ItemContext context = context_for(i);
  Operation operation = check_operation(context, entry);
  const bool good = context.good();
  keep(i, context);
  if (!good) return;
  operation.footprint = footprint(operation, *env_.library);
  env_.library->operations.push_back(std::move(operation));
}

}  // namespace gmsim::check
