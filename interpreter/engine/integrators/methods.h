// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/integrators/integrator.h"

namespace gmsim::engine {

#define INTEGRATOR(id, order, stages, adaptive, doc) \
  [[nodiscard]] std::unique_ptr<Integrator> make_##id();
#include "engine/integrators.def"
#undef INTEGRATOR

}  // namespace gmsim::engine
