// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "cli/session.h"
#include "compile/program.h"
#include "engine/frame.h"
#include "engine/matcher.h"
#include "engine/state.h"

namespace gmsim::cli {

/// The rule or the operation that a command names; exactly one of the two is set.
struct NamedItem {
  const compile::Rule* rule = nullptr;
  const compile::Operation* operation = nullptr;

  [[nodiscard]] const compile::ItemHead& head() const {
    return rule ? static_cast<const compile::ItemHead&>(*rule) : *operation;
  }
  [[nodiscard]] std::size_t hook_count() const { return rule ? rule->match.hooks.size() : 1; }
  /// One candidate per orbit of this type.
  [[nodiscard]] types::OrbitType orbit() const {
    return rule ? rule->match.hook_orbit() : operation->orbit;
  }
  [[nodiscard]] std::string describe(const engine::MatchFailure& failure) const;
};

/// Finds `options.rule` in the program; reports why it is not there.
[[nodiscard]] std::optional<NamedItem> find_named_item(const check::CheckedRules& rules,
                                                       const compile::Program& program,
                                                       Session& session);

/// Reads every `--param NAME=VALUE`: a constant expression of the parameter's type and unit.
bool read_arguments(const NamedItem& item, const check::CheckedRules& rules,
                    const engine::State& state, Session& session, engine::Arguments& arguments);

}  // namespace gmsim::cli
