// SPDX-License-Identifier: MIT
#pragma once

namespace gmsim::cli {

inline constexpr const char* kVersionText = "gmsim " GMSIM_VERSION;

}  // namespace gmsim::cli
