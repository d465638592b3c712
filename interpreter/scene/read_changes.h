// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scene/read_context.h"

/// What `prepare`, `rewrite` and `tear` have in common: a rule or an operation and its parameters.
namespace gmsim::scene {

/// The rule or operation of this name.
[[nodiscard]] std::optional<engine::NamedChange> read_change(const YamlNode& node,
                                                             ReadContext& context);
/// What it is called and takes.
[[nodiscard]] const compile::ItemHead& change_head(const engine::NamedChange& change,
                                                   const compile::Program& program);
/// The parameter that an entry of `params` gives.
[[nodiscard]] std::optional<std::pair<const compile::Parameter*, SceneExpression>> read_parameter(
    const YamlEntry& entry, const engine::NamedChange& change, ReadContext& context);
/// The parameters that `params` gives.
[[nodiscard]] std::vector<std::pair<const compile::Parameter*, SceneExpression>> read_parameters(
    const YamlNode* params, const engine::NamedChange& change, ReadContext& context);
/// Reports those that have no default and are not given.
void require_parameters(const std::vector<const compile::Parameter*>& given,
                        const engine::NamedChange& change, support::Span span,
                        ReadContext& context);
/// The orbits of which each is a candidate; rules with several hooks are refused.
[[nodiscard]] std::optional<types::OrbitType> read_candidates(const YamlNode& section,
                                                              const engine::NamedChange& change,
                                                              support::Span span,
                                                              ReadContext& context);

}  // namespace gmsim::scene
