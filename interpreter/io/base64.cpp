// SPDX-License-Identifier: MIT
#include "io/base64.h"

#include <cstdint>

namespace gmsim::io {

void append_base64(std::span<const std::byte> bytes, std::string& text) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t left = bytes.size() - at;
    std::uint32_t bits = static_cast<std::uint32_t>(bytes[at]) << 16;
    if (left > 1) bits |= static_cast<std::uint32_t>(bytes[at + 1]) << 8;
    if (left > 2) bits |= static_cast<std::uint32_t>(bytes[at + 2]);
    text += kDigits[bits >> 18];
    text += kDigits[(bits >> 12) & 63];
    text += left > 1 ? kDigits[(bits >> 6) & 63] : '=';
    text += left > 2 ? kDigits[bits & 63] : '=';
  }
}

}  // namespace gmsim::io
