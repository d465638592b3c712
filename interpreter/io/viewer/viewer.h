// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace gmsim::io {

/// page.html, with marks for what changes from run to run.
[[nodiscard]] std::string_view viewer_page();
/// viewer.bundle.js: the viewer and the part of three.js that it uses, in one script.
[[nodiscard]] std::string_view viewer_script();

}  // namespace gmsim::io
