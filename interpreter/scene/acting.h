// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "engine/matcher.h"
#include "scene/build_scene.h"

namespace gmsim::scene {

/// An interaction at work, and which use of it in the scene each orbit belongs to.
struct Acting {
  struct Use {
    const InteractionUse* use = nullptr;
    const InteractionUse::Member* member = nullptr;
  };
  std::vector<Use> uses;
  std::vector<std::uint32_t> use_of_row;  ///< by row of the presence mark; kNoUse
  static constexpr std::uint32_t kNoUse = 0xffffffffu;
};
using ActingInteractions =
    std::map<std::uint32_t, Acting>;  ///< by index into Program::interactions

/// Marks every orbit where the scene asks for an interaction and its pattern matches at some dart
/// for which `where` holds. Interactions that are marked nowhere are left out, with a warning.
[[nodiscard]] ActingInteractions mark_interactions(Building& building, engine::Matcher& matcher);

/// Decides how the parameters of one interaction are kept, and stores those that have a column.
[[nodiscard]] std::optional<engine::ActiveInteraction> bind_parameters(Building& building,
                                                                       engine::Matcher& matcher,
                                                                       std::uint32_t interaction,
                                                                       const Acting& acting);

}  // namespace gmsim::scene
