// SPDX-License-Identifier: MIT
// KernelForces: the plan as text.
#include <fmt/format.h>

#include "engine/kernel_forces.h"

namespace gmsim::engine {

namespace {

std::string parameter_text(const compile::BodyParameter& parameter,
                           const ParameterBinding& binding, const gmap::EmbeddingSchema& schema) {
  switch (binding.kind) {
    case ParameterBinding::Kind::Uniform:
      return fmt::format("{} = {} (constant)", parameter.name, types::to_string(binding.uniform));
    case ParameterBinding::Kind::Stored:
      return fmt::format("{}: a column on {}", parameter.name,
                         types::to_string(schema[binding.embedding].orbit));
    case ParameterBinding::Kind::OfTime:
      return fmt::format("{}: computed at every stage", parameter.name);
  }
  return {};
}

/// The embeddings that a program gathers, each once.
std::string gathered_text(const ForceProgram& program, const gmap::EmbeddingSchema& schema) {
  std::set<std::string> names;
  for (const auto& [number, origin] : program.inputs) {
    switch (origin.kind) {
      case InputOrigin::Kind::Position: names.insert("position"); break;
      case InputOrigin::Kind::Velocity: names.insert("velocity"); break;
      case InputOrigin::Kind::Column: names.insert(schema[origin.embedding].name); break;
      case InputOrigin::Kind::Time: names.insert("time"); break;
      case InputOrigin::Kind::Dt: names.insert("dt"); break;
      case InputOrigin::Kind::Step: names.insert("step"); break;
      default: break;
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string merged_text(const MergedTable& merged, const gmap::EmbeddingSchema& schema) {
  std::string summed;
  for (const auto& [origin, is_summed] : merged.plan().columns)
    if (is_summed && origin.kind == InputOrigin::Kind::Column)
      summed += (summed.empty() ? "" : ", ") + schema[origin.embedding].name;
  return fmt::format(", merged to {} ({})", merged.table().count(),
                     merged.plan().counted ? "equal ones counted" : "adding up " + summed);
}

}  // namespace

std::string KernelForces::explain() const {
  const gmap::EmbeddingSchema& schema = context_.state.program.schema;
  std::string text = "forces\n";
  for (const auto& of : interactions_) {
    const char* remark = of->match_count() == 0 ? ": holds nowhere, not computed"
                         : of->matches().repairable() ? ""
                                                      : ": found anew after every change of the map";
    text += fmt::format("  {} on {}{}\n", of->body().name, types::to_string(of->body().orbit), remark);
    if (of->match_count() == 0) continue;
    const auto& bindings = context_.active[of->number()].parameters;
    for (std::size_t k = 0; k < bindings.size(); ++k)
      text += fmt::format("    {}\n", parameter_text(of->body().parameters[k], bindings[k], schema));
  }
  text += "tables\n";
  main_.each_kernel([&](const ForcePass::KernelAtWork& work) {
    const InteractionTables& of = *work.of;
    const compile::Kernel& kernel = work.kernel->kernel();
    text += fmt::format("  {}: {} matches{}\n", of.body().name, of.table(work.shape).count(),
                        work.merged ? merged_text(*of.merged(work.shape), schema) : "");
    text += fmt::format("    reads {}\n", gathered_text(of.kernels(work.shape).program(), schema));
    text += fmt::format("    {} operations and {} bytes a match, {} instructions, {} forces\n",
                        kernel.operations(), kernel.bytes(), kernel.code.size(),
                        of.shape(work.shape).forces.size());
  });
  if (atomic_) {
    text += "forces of single matches, once a step, for criteria\n";
    atomic_->each_kernel([&](const ForcePass::KernelAtWork& work) {
      text += fmt::format("  {}: {} matches\n", work.of->body().name, work.table->count());
    });
  }
  text += fmt::format("machine\n  {} threads, instruction set {}\n", workers_.threads.count(),
                      name_of(preferred_isa()));
  main_.each_kernel([&](const ForcePass::KernelAtWork& work) {
    text += fmt::format("  {}: blocks of {} matches\n", work.of->body().name,
                        work.kernel->kernel().block);
  });
  return text;
}

}  // namespace gmsim::engine
