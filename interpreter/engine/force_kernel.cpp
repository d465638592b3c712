// SPDX-License-Identifier: MIT
#include "engine/force_kernel.h"

#include <algorithm>
#include <utility>

#include "engine/force_readings.h"
#include "support/check.h"

namespace gmsim::engine {

namespace {

const double* numbers(std::span<const VertexRecord> records) {
  return records.empty() ? nullptr : &records.front().x;
}

}  // namespace

ForceKernel::ForceKernel(ForceProgram program)
    : program_(std::move(program)),
      kernel_(compile::compile_kernel(program_.graph, share_opposites())) {
  for (const compile::KernelInput& input : kernel_.inputs) {
    const auto live = std::find_if(program_.inputs.begin(), program_.inputs.end(),
                                   [&](const auto& l) { return l.number == input.input; });
    GMSIM_CHECK(live != program_.inputs.end(), "a kernel reads an input that nobody knows");
    origins_.push_back(live->origin);
  }
}

std::vector<compile::ir::NodeId> ForceKernel::share_opposites() {
  namespace ir = compile::ir;
  const std::vector<ir::NodeId>& roots = program_.roots;
  const auto is_vector = [&](ir::NodeId node) {
    return program_.graph[node].type == types::ValueKind::Vec3;
  };
  const auto negated = [&](ir::NodeId node) {
    return program_.graph[node].op == ir::Op::Neg ? program_.graph[node].operands[0] : ir::kNone;
  };
  std::vector<ir::NodeId> computed;
  for (const ir::NodeId root : roots) {
    const auto other = std::find_if(computed.begin(), computed.end(), [&](ir::NodeId node) {
      return is_vector(root) && (negated(root) == node || negated(node) == root);
    });
    roots_.push_back({static_cast<std::uint32_t>(other - computed.begin()), other != computed.end()});
    if (other == computed.end()) computed.push_back(root);
  }
  return computed;
}

InputBinding ForceKernel::binding(const InputOrigin& origin, const MatchTable& table,
                                  const gmap::EmbeddingStore& store,
                                  const ForceMoment& moment) const {
  using Kind = InputOrigin::Kind;
  constexpr std::uint32_t kRecord = sizeof(VertexRecord) / sizeof(double);
  const auto vertex = [&](const std::span<const VertexRecord> records) {
    return InputBinding{numbers(records), kRecord, table.rows(origin.role).data(), true};
  };
  switch (origin.kind) {
    case Kind::Position: return vertex(moment.position);
    case Kind::Velocity: return vertex(moment.velocity);
    case Kind::PositionChange: return vertex(moment.position_change);
    case Kind::VelocityChange: return vertex(moment.velocity_change);
    case Kind::Column: {
      const gmap::EmbeddingColumn& column = store.column(origin.embedding);
      return {column.data().data() + origin.offset, column.stride(),
              table.rows(origin.role).data(), true};
    }
    case Kind::Own: {
      const MatchTable::OwnColumn own = table.own(origin.offset);
      return {own.begin, own.stride, nullptr, true};
    }
    case Kind::ForceOn: return vertex(moment.forces->values(origin.orbit, origin.offset));
    case Kind::AtomicForce: return vertex(moment.forces->atomic);
    case Kind::Time: return {&moment.time};
    case Kind::Dt: return {&moment.dt};
    case Kind::Step: return {&moment.step};
  }
  return {};
}

void ForceKernel::bind(const MatchTable& table, const gmap::EmbeddingStore& store,
                       const ForceMoment& moment, std::vector<InputBinding>& bindings) const {
  bindings.clear();
  for (const InputOrigin& origin : origins_)
    bindings.push_back(binding(origin, table, store, moment));
}

void ForceKernel::bind_again(const MatchTable& table, const gmap::EmbeddingStore& store,
                             const ForceMoment& moment, std::vector<InputBinding>& bindings) const {
  using Kind = InputOrigin::Kind;
  for (std::size_t k = 0; k < origins_.size(); ++k)
    if (origins_[k].kind != Kind::Column && origins_[k].kind != Kind::Own)
      bindings[k] = binding(origins_[k], table, store, moment);
}

std::optional<std::uint32_t> ForceKernel::run(const MatchTable& table,
                                              std::span<const InputBinding> inputs,
                                              std::span<const OutputBinding> outputs,
                                              std::uint32_t begin, std::uint32_t end,
                                              KernelScratch& scratch) const {
  while (const auto row = run_kernel(kernel_, inputs, outputs, begin, end, scratch)) {
    if (!table.vacant(*row)) return row;
    begin = *row + 1;
  }
  return std::nullopt;
}

}  // namespace gmsim::engine
