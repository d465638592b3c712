// SPDX-License-Identifier: MIT
#include "support/source_map.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "support/check.h"

namespace gmsim::support {
namespace {

std::vector<std::uint32_t> find_line_starts(std::string_view text) {
  std::vector<std::uint32_t> starts{0};
  for (std::size_t i = text.find('\n'); i != std::string_view::npos; i = text.find('\n', i + 1))
    starts.push_back(static_cast<std::uint32_t>(i + 1));
  return starts;
}

}  // namespace

FileId SourceMap::add(std::string name, std::string text) {
  GMSIM_CHECK(text.size() < std::numeric_limits<std::uint32_t>::max(),
              "a source text must be smaller than 4 GiB");
  std::vector<std::uint32_t> line_starts = find_line_starts(text);
  files_.push_back({std::move(name), std::move(text), std::move(line_starts)});
  return FileId{static_cast<std::uint32_t>(files_.size() - 1)};
}

const SourceMap::File& SourceMap::at(FileId file) const {
  const auto i = static_cast<std::size_t>(file);
  GMSIM_CHECK(i < files_.size(), "file id of another source map");
  return files_[i];
}

const std::string& SourceMap::name(FileId file) const {
  return at(file).name;
}

std::string_view SourceMap::text(FileId file) const {
  return at(file).text;
}

std::string_view SourceMap::text(Span span) const {
  const std::string_view all = text(span.file);
  const std::size_t begin = std::min<std::size_t>(span.begin, all.size());
  const std::size_t end = std::min<std::size_t>(span.end, all.size());
  return begin < end ? all.substr(begin, end - begin) : std::string_view{};
}

LineColumn SourceMap::locate(FileId file, std::uint32_t offset) const {
  const File& source = at(file);
  const auto clamped =
      static_cast<std::uint32_t>(std::min<std::size_t>(offset, source.text.size()));
  const auto next = std::upper_bound(source.line_starts.begin(), source.line_starts.end(), clamped);
  const auto line = static_cast<std::uint32_t>(next - source.line_starts.begin());
  return {line, clamped - source.line_starts[line - 1] + 1};
}

std::uint32_t SourceMap::line_start(FileId file, std::uint32_t line) const {
  const File& source = at(file);
  GMSIM_CHECK(line >= 1 && line <= source.line_starts.size(), "line number out of range");
  return source.line_starts[line - 1];
}

std::string_view SourceMap::line(FileId file, std::uint32_t line) const {
  const std::uint32_t begin = line_start(file, line);
  const std::string_view rest = text(file).substr(begin);
  std::string_view found = rest.substr(0, rest.find('\n'));
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

}  // namespace gmsim::support
