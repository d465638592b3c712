// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/model.h"

namespace gmsim::tests {

/// A method and its step (s); a step above the limit is an error.
inline engine::IntegratorSettings with(const std::string& method, double dt) {
  engine::IntegratorSettings settings;
  settings.method = method;
  settings.dt = dt;
  return settings;
}
/// The same where a step above the limit is only warned about.
inline engine::IntegratorSettings with_warning(const std::string& method, double dt) {
  engine::IntegratorSettings settings = with(method, dt);
  settings.on_unstable = engine::OnUnstable::Warn;
  return settings;
}

}  // namespace gmsim::tests
