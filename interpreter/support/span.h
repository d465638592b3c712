// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace gmsim::support {

/// Index of a text in a SourceMap.
enum class FileId : std::uint32_t {};

/// Half-open range of bytes in one source text. Lines and columns are computed when printing.
struct Span {
  FileId file{};
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  bool operator==(const Span&) const = default;
  [[nodiscard]] bool empty() const { return begin >= end; }
};

/// The smallest span that covers both, which must lie in one file.
inline Span join(Span a, Span b) {
  return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

}  // namespace gmsim::support
