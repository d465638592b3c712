// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace gmsim::support {

/// Names of fields in a file of frames may not be empty, nor hold `/`, `.` or anything that cannot be
/// printed: VTK refuses them.
[[nodiscard]] bool is_field_name(std::string_view name);
/// The expression of a field as a name: "norm(force_on(a))" becomes "norm_force_on_a".
[[nodiscard]] std::string field_name(std::string_view expression);

}  // namespace gmsim::support
