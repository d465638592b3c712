// SPDX-License-Identifier: MIT
#pragma once

namespace gmsim::cli {

[[nodiscard]] const char* version();       ///< "0.1.0"
[[nodiscard]] const char* commit();        ///< of the source this was built from; "unknown"
[[nodiscard]] const char* version_text();  ///< "gmsim 0.1.0"

}  // namespace gmsim::cli
