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

const ForceKernel& ShapeKernels::product() {
  if (!product_) product_ = std::make_unique<ForceKernel>(product_program(force_.program()));
  return *product_;
}

InteractionTables::InteractionTables(const ForceContext& context, std::uint32_t number, bool merge)
    : context_(context), number_(number), merge_(merge), finder_(context, number) {}

std::optional<support::Diagnostic> InteractionTables::rebuild() {
  for (const auto& table : tables_) table->clear();
  places_.assign(context_.state.map.dart_end(), {});
  if (auto error = finder_.find_all([&](const ForceMatch& match) { add(match); })) return error;
  for (std::size_t shape = 0; shape < tables_.size(); ++shape)
    if (merged_[shape]) merged_[shape]->rebuild(*tables_[shape], context_.state.store);
  return std::nullopt;
}

void InteractionTables::add(const ForceMatch& match) {
  while (tables_.size() <= match.shape) add_shape();
  if (places_.size() <= types::index(match.key)) places_.resize(context_.state.map.dart_end());
  places_[types::index(match.key)] = {match.shape, tables_[match.shape]->add(match)};
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
  std::optional<MergePlan> plan;
  if (merge_) plan = plan_merge(shape, kernels_.back()->force().program());
  merged_.push_back(plan ? std::make_unique<MergedTable>(std::move(*plan)) : nullptr);
}

std::uint32_t InteractionTables::match_count() const {
  std::uint32_t count = 0;
  for (const auto& table : tables_) count += table->size();
  return count;
}

}  // namespace gmsim::engine
