// SPDX-License-Identifier: MIT
#include "scene/msh_elements.h"

#include <algorithm>
#include <array>

namespace gmsim::scene {

const MshElement* find_msh_element(std::int32_t type) {
#define MSH_LINEAR(number, name, corners, kind) MshElement{number, name, corners, kind},
#define MSH_OTHER(number, name) MshElement{number, name, 0, std::nullopt},
  static const std::array kElements = {
#include "scene/msh_elements.def"
  };
#undef MSH_LINEAR
#undef MSH_OTHER
  const auto* found = std::find_if(kElements.begin(), kElements.end(),
                                   [&](const MshElement& element) { return element.type == type; });
  return found == kElements.end() ? nullptr : found;
}

}  // namespace gmsim::scene
