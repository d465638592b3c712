// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gmsim::support {

/// Names close to `name` by edit distance (at most a third of its length), nearest first, at most
/// three.
[[nodiscard]] std::vector<std::string> close_names(std::string_view name,
                                                   const std::vector<std::string>& candidates);

/// "did you mean `a` or `b`?", empty when nothing is close.
[[nodiscard]] std::string did_you_mean(std::string_view name,
                                       const std::vector<std::string>& candidates);

}  // namespace gmsim::support
