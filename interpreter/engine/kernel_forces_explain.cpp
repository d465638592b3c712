// SPDX-License-Identifier: MIT
// KernelForces: the plan as text.
#include <fmt/format.h>

#include "engine/kernel_forces.h"

namespace gmsim::engine {

std::string KernelForces::explain() const {
  std::string text;
  for (const auto& of : interactions_)
    text += fmt::format("{}: {} matches\n", of->body().name, of->match_count());
  return text;
}

}  // namespace gmsim::engine
