// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "support/span.h"

namespace gmsim::support {

/// 1-based line and 1-based column in bytes.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

/// Owns the text of every file read in a run; texts never move or change once added.
class SourceMap {
 public:
  FileId add(std::string name, std::string text);

  [[nodiscard]] const std::string& name(FileId file) const;
  [[nodiscard]] std::string_view text(FileId file) const;
  [[nodiscard]] std::string_view text(Span span) const;
  /// Offsets past the end of the text are taken as its end.
  [[nodiscard]] LineColumn locate(FileId file, std::uint32_t offset) const;
  /// The text of a 1-based line without its line end.
  [[nodiscard]] std::string_view line(FileId file, std::uint32_t line) const;
  /// Offset of the first byte of a 1-based line.
  [[nodiscard]] std::uint32_t line_start(FileId file, std::uint32_t line) const;
  [[nodiscard]] std::size_t size() const { return files_.size(); }

 private:
  struct File {
    std::string name;
    std::string text;
    std::vector<std::uint32_t> line_starts;
  };
  [[nodiscard]] const File& at(FileId file) const;

  std::deque<File> files_;
};

}  // namespace gmsim::support
