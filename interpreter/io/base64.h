// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gmsim::io {

/// RFC 4648, with padding.
void append_base64(std::span<const std::byte> bytes, std::string& text);

}  // namespace gmsim::io
