// SPDX-License-Identifier: MIT
#include "engine/atomic_forces.h"
#include "engine/kernel_forces.h"

namespace gmsim::engine {

namespace {

/// By root: how many darts that a match names share its force.
std::vector<double> shares(const compile::Shape& shape) {
  std::vector<double> count(shape.forces.size(), 0);
  for (const compile::ForceTarget& target : shape.targets) count[target.root] += 1;
  for (double& c : count) c = 1 / c;
  return count;
}

}  // namespace

void KernelForces::list_atomic(std::vector<AtomicForce>& out) const {
  if (!atomic_) return;
  for (const auto& of : interactions_) {
    if (of->body().external) continue;
    std::vector<std::vector<double>> shares_of;
    for (std::size_t shape = 0; shape < of->shape_count(); ++shape)
      shares_of.push_back(shares(of->shape(shape)));
    of->in_order([&](std::uint32_t shape, std::uint32_t row) {
      const std::span<const DartId> darts = of->table(shape).targets(row);
      const auto& targets = of->shape(shape).targets;
      for (std::size_t t = 0; t < targets.size(); ++t) {
        const SignedSlot slot = atomic_->slot(*of, shape, targets[t].root, row);
        const double share = shares_of[shape][targets[t].root];
        out.push_back({darts[t], targets[t].orbit, of->body().id, number_of(slot),
                       is_negative(slot) ? -share : share});
      }
    });
  }
}

}  // namespace gmsim::engine
