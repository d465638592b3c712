// SPDX-License-Identifier: MIT
#include "engine/force_tables.h"

#include <utility>

namespace gmsim::engine {

const ForceKernel* ShapeKernels::made(Lazy& lazy, Make& make) {
  if (!std::exchange(lazy.asked, true)) {
    ForceProgram program = make(shape_, inputs_);
    if (!program.roots.empty()) lazy.kernel = std::make_unique<ForceKernel>(std::move(program));
  }
  return lazy.kernel.get();
}

const ForceKernel& ShapeKernels::force() {
  if (!force_) force_ = std::make_unique<ForceKernel>(program_);
  return *force_;
}

const ForceKernel& ShapeKernels::product() {
  if (!product_) product_ = std::make_unique<ForceKernel>(product_program(program_));
  return *product_;
}

InteractionTables::InteractionTables(const ForceContext& context, std::uint32_t number, bool merge)
    : context_(context),
      number_(number),
      merge_(merge),
      finder_(context, number),
      watch_(context, context.pattern(number), context.body(number)) {
  finder_.on_excluded([this](const ForceMatch& match) { watch_.add(match); });
}

std::optional<support::Diagnostic> InteractionTables::rebuild() {
  for (const auto& table : tables_) table->clear();
  watch_.clear();
  places_.assign(context_.state.map.dart_end(), {});
  if (auto error = finder_.find_all([&](const ForceMatch& match) { add(match); })) return error;
  watch_.pack();
  merge();
  return std::nullopt;
}

void InteractionTables::merge() {
  for (std::size_t shape = 0; shape < tables_.size(); ++shape)
    if (merged_[shape]) merged_[shape]->rebuild(*tables_[shape], context_.state.store);
}

void InteractionTables::pack() {
  std::vector<std::vector<std::uint32_t>> rows(tables_.size());
  for (Place& place : places_) {
    if (place.shape == kNowhere) continue;
    rows[place.shape].push_back(place.row);
    place.row = static_cast<std::uint32_t>(rows[place.shape].size()) - 1;
  }
  for (std::size_t shape = 0; shape < tables_.size(); ++shape) tables_[shape]->pack(rows[shape]);
  merge();
}

void InteractionTables::add(const ForceMatch& match) {
  while (tables_.size() <= match.shape) add_shape();
  if (places_.size() <= types::index(match.key)) places_.resize(context_.state.map.dart_end());
  places_[types::index(match.key)] = {match.shape, tables_[match.shape]->add(match)};
  watch_.add(match);
}

std::optional<support::Diagnostic> InteractionTables::find_at(DartId dart,
                                                              std::optional<DartId>& key) {
  key.reset();
  return finder_.find_at(dart, [&](const ForceMatch& match) {
    add(match);
    key = match.key;
  });
}

DartId InteractionTables::hook(Place place) const {
  return tables_[place.shape]->nodes(place.row)[body().hook];
}

void InteractionTables::remove(DartId key) {
  const Place place = std::exchange(places_[types::index(key)], Place{});
  tables_[place.shape]->vacate(place.row);
}

void InteractionTables::add_shape() {
  const auto number = static_cast<std::uint32_t>(tables_.size());
  const compile::Shape& shape = finder_.shapes()[number];
  const ShapeInputs& inputs = finder_.inputs(number);
  tables_.push_back(std::make_unique<MatchTable>(MatchTable::Widths{
      .roles = static_cast<std::uint32_t>(shape.roles.size()),
      .nodes = static_cast<std::uint32_t>(body().nodes.size()),
      .targets = static_cast<std::uint32_t>(shape.targets.size()),
      .own = inputs.own_widths()}));
  kernels_.push_back(std::make_unique<ShapeKernels>(shape, inputs));
  own_stay_ = own_stay_ && inputs.own_stay_in_orbits();
  std::optional<MergePlan> plan;
  if (merge_) plan = plan_merge(shape, kernels_.back()->program());
  merged_.push_back(plan ? std::make_unique<MergedTable>(std::move(*plan)) : nullptr);
}

std::uint32_t InteractionTables::match_count() const {
  std::uint32_t count = 0;
  for (const auto& table : tables_) count += table->count();
  return count;
}

}  // namespace gmsim::engine
