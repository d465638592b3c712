// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/model.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// A row of integrators.def.
struct IntegratorInfo {
  std::string_view name;
  int order = 0;
  int stages = 0;  ///< evaluations of all forces a step
  bool adaptive = false;
  std::string_view doc;
};
[[nodiscard]] std::span<const IntegratorInfo> integrators();
/// Null when there is no such method.
[[nodiscard]] const IntegratorInfo* find_integrator(std::string_view name);

/// What is wrong with the settings themselves, whatever the model is.
[[nodiscard]] std::optional<support::Diagnostic> settings_problem(
    const IntegratorSettings& settings);

}  // namespace gmsim::engine
