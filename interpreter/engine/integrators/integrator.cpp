// SPDX-License-Identifier: MIT
#include "engine/integrators/integrator.h"

#include <string>

#include "engine/integrators/methods.h"
#include "support/check.h"

namespace gmsim::engine {

double Integrator::error_norm(const EquationsOfMotion&, const PhasePoint&, const PhasePoint&,
                              double, const Tolerance&) const {
  return 0;
}

std::unique_ptr<Integrator> make_integrator(const IntegratorInfo& info) {
#define INTEGRATOR(id, order, stages, adaptive, doc) \
  if (info.name == #id) return make_##id();
#include "engine/integrators.def"
#undef INTEGRATOR
  support::internal_error(__FILE__, __LINE__, "no code for " + std::string(info.name));
}

}  // namespace gmsim::engine
