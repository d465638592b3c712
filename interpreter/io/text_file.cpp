// SPDX-License-Identifier: MIT
#include "io/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace gmsim::io {

bool write_file(const std::filesystem::path& path, std::string_view text,
                support::Diagnostics& diagnostics) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (out) return true;
  diagnostics.report(
      {.kind = support::DiagnosticKind::FileError,
       .message = fmt::format("{}: the file cannot be written: {}", path.string(),
                              errno != 0 ? std::strerror(errno) : "unknown reason")});
  return false;
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace gmsim::io
