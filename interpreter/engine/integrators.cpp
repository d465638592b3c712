// SPDX-License-Identifier: MIT
#include "engine/integrators.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/suggest.h"

namespace gmsim::engine {
namespace {

constexpr IntegratorInfo kIntegrators[] = {
#define INTEGRATOR(id, order, stages, adaptive, doc) {#id, order, stages, adaptive, doc},
#include "engine/integrators.def"
#undef INTEGRATOR
};

/// Names of the scene format that stand for methods which solve equations.
constexpr std::array<std::string_view, 6> kImplicitMethods = {
    "backward_euler", "bdf2", "newmark", "implicit_midpoint", "static", "auto"};

support::Diagnostic unknown_method(const IntegratorSettings& settings) {
  std::vector<std::string> names;
  std::string list;
  for (const IntegratorInfo& row : kIntegrators) {
    names.emplace_back(row.name);
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", row.name);
  }
  support::Diagnostic problem{support::DiagnosticKind::UnknownIntegrator, {}, settings.span};
  problem.help = "methods are " + list;
  if (std::ranges::find(kImplicitMethods, settings.method) != kImplicitMethods.end()) {
    problem.message = fmt::format(
        "integrator method `{}` is not available: this version has explicit methods only",
        settings.method);
    return problem;
  }
  problem.message = fmt::format("unknown integrator method `{}`", settings.method);
  const std::string guess = support::did_you_mean(settings.method, names);
  if (!guess.empty()) problem.help += "; " + guess;
  return problem;
}

}  // namespace

std::span<const IntegratorInfo> integrators() { return kIntegrators; }

const IntegratorInfo* find_integrator(std::string_view name) {
  const auto* const row = std::ranges::find(kIntegrators, name, &IntegratorInfo::name);
  return row == std::end(kIntegrators) ? nullptr : row;
}

std::optional<support::Diagnostic> settings_problem(const IntegratorSettings& settings) {
  if (find_integrator(settings.method) == nullptr) return unknown_method(settings);
  const auto wrong = [&](std::string_view key, double value, std::string_view demand) {
    return support::Diagnostic{support::DiagnosticKind::BadIntegrator,
                               fmt::format("`{}` is {}, but must be {}", key, value, demand),
                               settings.span};
  };
  const std::pair<const char*, double> sizes[] = {{"dt", settings.dt},
                                                  {"atol_position", settings.atol_position},
                                                  {"atol_velocity", settings.atol_velocity},
                                                  {"dt_min", settings.dt_min},
                                                  {"dt_max", settings.dt_max}};
  for (const auto& [key, value] : sizes)
    if (!std::isfinite(value) || value < 0) return wrong(key, value, "finite and not negative");
  if (!std::isfinite(settings.rtol) || settings.rtol <= 0 || settings.rtol >= 1)
    return wrong("rtol", settings.rtol, "between 0 and 1");
  if (settings.dt_max > 0 && settings.dt_max < settings.dt_min)
    return wrong("dt_max", settings.dt_max, "at least `dt_min`");
  return std::nullopt;
}

}  // namespace gmsim::engine
