// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/tear_model.h"
#include "scene/read_context.h"

namespace gmsim::scene {

/// The lists `tear` and `rewrite`.
[[nodiscard]] std::vector<engine::TearPairing> read_tears(const YamlNode& scene,
                                                          ReadContext& context);
[[nodiscard]] std::vector<engine::StandingRewrite> read_rewrites(const YamlNode& scene,
                                                                 ReadContext& context);

}  // namespace gmsim::scene
