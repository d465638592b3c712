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
      matches_(context, context.pattern(number), context.world, context.body(number),
               compile::wanted_forces(context.body(number), true), context.sources) {}

std::optional<support::Diagnostic> InteractionTables::rebuild() {
  if (auto error = matches_.rebuild()) return error;
  add_kernels();
  merge();
  return std::nullopt;
}

std::optional<support::Diagnostic> InteractionTables::find_at(DartId dart,
                                                              std::optional<DartId>& key) {
  auto error = matches_.find_at(dart, key);
  add_kernels();
  return error;
}

void InteractionTables::merge() {
  for (std::size_t shape = 0; shape < merged_.size(); ++shape)
    if (merged_[shape]) merged_[shape]->rebuild(table(shape), context_.state.store);
}

void InteractionTables::pack() {
  matches_.pack();
  merge();
}

void InteractionTables::add_kernels() {
  while (kernels_.size() < matches_.shape_count()) {
    const auto number = static_cast<std::uint32_t>(kernels_.size());
    const compile::Shape& shape = matches_.shape(number);
    kernels_.push_back(std::make_unique<ShapeKernels>(shape, matches_.inputs(number)));
    std::optional<MergePlan> plan;
    if (merge_) plan = plan_merge(shape, kernels_.back()->program());
    merged_.push_back(plan ? std::make_unique<MergedTable>(std::move(*plan)) : nullptr);
  }
}

}  // namespace gmsim::engine
