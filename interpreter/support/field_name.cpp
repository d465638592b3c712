// SPDX-License-Identifier: MIT
#include "support/field_name.h"

#include <algorithm>
#include <cctype>

namespace gmsim::support {

bool is_field_name(std::string_view name) {
  const auto is_bad = [](unsigned char c) { return c <= ' ' || c > '~' || c == '/' || c == '.'; };
  return !name.empty() && std::none_of(name.begin(), name.end(), is_bad);
}

std::string field_name(std::string_view expression) {
  std::string name;
  for (unsigned char c : expression) {
    if (std::isalnum(c) != 0) {
      name += static_cast<char>(c);
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "field" : name;
}

}  // namespace gmsim::support
