// SPDX-License-Identifier: MIT
#include "types/orbit_type.h"

namespace gmsim::types {

std::string to_string(OrbitType type) {
  std::string text = "<";
  for (int i = 0; i <= kMaxDimension; ++i) {
    if (!type.contains(i)) continue;
    if (text.size() > 1) text += ',';
    text += std::to_string(i);
  }
  return text + ">";
}

}  // namespace gmsim::types
