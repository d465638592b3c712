// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <tuple>
#include <utility>

#include "support/diagnostic.h"

namespace gmsim::support {
namespace {

constexpr std::uint32_t kTabWidth = 4;
/// Of a line longer than this only the surroundings of the first mark are shown (in bytes).
constexpr std::size_t kLongestLine = 400;
constexpr std::size_t kBytesBefore = 60;
constexpr std::size_t kBytesAfter = 100;

/// An underlined range of one line, as offsets into the file.
struct Mark {
  std::uint32_t begin;
  std::uint32_t end;
  char symbol;  // '^' the place itself, '-' what explains it
  std::string_view text;
};

using MarkedLines = std::map<std::uint32_t, std::vector<Mark>>;

/// Length in bytes of the UTF-8 sequence at `i`; 0 when the bytes there are none.
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
  return length;
}

/// What is printed for a source line, and in which printed column each of its bytes ends up.
/// Tabs become spaces; control characters and bytes that are no UTF-8 become U+FFFD.
class ShownLine {
 public:
  ShownLine(std::string_view line, std::uint32_t file_offset, std::uint32_t anchor) {
    std::size_t first = 0;
    std::size_t last = line.size();
    if (line.size() > kLongestLine) {
      const std::size_t center = std::min<std::size_t>(anchor - file_offset, line.size());
      first = center > kBytesBefore ? center - kBytesBefore : 0;
      last = std::min(line.size(), center + kBytesAfter);
    }
    offset_ = file_offset + static_cast<std::uint32_t>(first);
    if (first > 0) append("…", 1);
    for (std::size_t i = first; i < last;) i += append_character(line, i, last);
    columns_.push_back(width_);
    if (last < line.size()) append("…", 1);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  /// Printed column, from 0, of a file offset; offsets outside of the line give its ends.
  [[nodiscard]] std::uint32_t column(std::uint32_t offset) const {
    const std::size_t i = offset > offset_ ? offset - offset_ : 0;
    return columns_[std::min(i, columns_.size() - 1)];
  }

 private:
  void append(std::string_view shown, std::uint32_t width) {
    text_ += shown;
    width_ += width;
  }

  /// Returns the number of bytes taken. Bytes inside of a character map to the column after it.
  std::size_t append_character(std::string_view line, std::size_t i, std::size_t last) {
    const std::size_t length = std::clamp<std::size_t>(sequence_length(line, i), 1, last - i);
    columns_.push_back(width_);
    const auto lead = static_cast<unsigned char>(line[i]);
    if (lead == '\t') {
      const std::uint32_t width = kTabWidth - width_ % kTabWidth;
      append(std::string(width, ' '), width);
    } else if (lead < 0x20 || lead == 0x7f || sequence_length(line, i) != length) {
      append("\ufffd", 1);
    } else {
      append(line.substr(i, length), 1);
    }
    columns_.insert(columns_.end(), length - 1, width_);
    return length;
  }

  std::uint32_t offset_ = 0;
  std::string text_;
  std::vector<std::uint32_t> columns_;
  std::uint32_t width_ = 0;
};

/// Cuts a span to its first line and files the mark under that line.
void add_mark(MarkedLines& lines, const SourceMap& sources, Span span, char symbol,
              std::string_view text) {
  const std::uint32_t number = sources.locate(span.file, span.begin).line;
  const std::string_view line = sources.line(span.file, number);
  const std::uint32_t start = sources.line_start(span.file, number);
  const auto line_end = start + static_cast<std::uint32_t>(line.size());
  std::uint32_t end = span.end;
  if (end > line_end) {
    const std::size_t last = line.find_last_not_of(" \t");
    end = start + static_cast<std::uint32_t>(last == std::string_view::npos ? 0 : last + 1);
  }
  const std::uint32_t begin = std::min(span.begin, line_end);
  lines[number].push_back({begin, std::max(begin, end), symbol, text});
}

/// One printed row of marks; its text, if any, stands after the last of them.
struct MarkRow {
  std::string marks;
  std::string_view text;

  /// Is there room for marks in columns [begin, end) with a blank on either side?
  [[nodiscard]] bool has_room(std::uint32_t begin, std::uint32_t end, bool with_text) const {
    if (marks.size() < begin) return text.empty();
    const std::size_t next = marks.find_first_not_of(' ', begin > 0 ? begin - 1 : 0);
    return !with_text && next != std::string::npos && next > end;
  }
  void put(std::uint32_t begin, std::uint32_t end, char symbol) {
    if (marks.size() < end) marks.resize(end, ' ');
    std::fill(marks.begin() + begin, marks.begin() + end, symbol);
  }
};

/// Lays out the marks of one line in as few rows as keep each of them and its text in sight;
/// the carets come first.
std::vector<MarkRow> mark_rows(std::vector<Mark> marks, const ShownLine& shown) {
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) {
    return std::tuple(a.symbol != '^', a.begin) < std::tuple(b.symbol != '^', b.begin);
  });
  std::vector<MarkRow> rows;
  for (const Mark& mark : marks) {
    const std::uint32_t begin = shown.column(mark.begin);
    const std::uint32_t end = std::max(shown.column(mark.end), begin + 1);
    auto row = std::find_if(rows.begin(), rows.end(), [&](const MarkRow& candidate) {
      return candidate.has_room(begin, end, !mark.text.empty());
    });
    if (row == rows.end()) row = rows.emplace(rows.end());
    row->put(begin, end, mark.symbol);
    if (!mark.text.empty()) row->text = mark.text;
  }
  return rows;
}

/// Prints one diagnostic; the gutter is as wide as its largest line number.
class Renderer {
 public:
  Renderer(const Diagnostic& diagnostic, const SourceMap& sources, std::ostream& out)
      : diagnostic_(diagnostic), sources_(sources), out_(out) {}

  void print() {
    const char* severity = diagnostic_.severity == Severity::Error ? "error" : "warning";
    out_ << fmt::format("{}: {} [{}]\n", severity, diagnostic_.message, name_of(diagnostic_.kind));
    if (diagnostic_.place) print_places();
    for (const std::string& note : diagnostic_.notes) out_ << "note: " << note << '\n';
    if (!diagnostic_.help.empty()) out_ << "help: " << diagnostic_.help << '\n';
  }

 private:
  void print_places() {
    const Span& place = *diagnostic_.place;
    std::map<FileId, MarkedLines> files;
    add_mark(files[place.file], sources_, place, '^', {});
    for (const Label& label : diagnostic_.related)
      add_mark(files[label.span.file], sources_, label.span, '-', label.text);
    for (const auto& [file, lines] : files)
      gutter_ = std::max(gutter_, std::to_string(lines.rbegin()->first).size());

    print_file("-->", place.file, place.begin, files[place.file]);
    for (const auto& [file, lines] : files)
      if (file != place.file) print_file(":::", file, lines.begin()->second.front().begin, lines);
  }

  void print_file(const char* arrow, FileId file, std::uint32_t offset, const MarkedLines& lines) {
    const LineColumn at = sources_.locate(file, offset);
    out_ << fmt::format("{:{}}{} {}:{}:{}\n", "", gutter_, arrow, sources_.name(file), at.line,
                        at.column);
    print_row("", "");
    std::uint32_t previous = 0;
    for (const auto& [number, marks] : lines) {
      if (previous != 0 && number == previous + 2) print_line(file, previous + 1, {});
      if (previous != 0 && number > previous + 2) out_ << "...\n";
      print_line(file, number, marks);
      previous = number;
    }
  }

  void print_line(FileId file, std::uint32_t number, const std::vector<Mark>& marks) {
    const std::uint32_t start = sources_.line_start(file, number);
    const ShownLine shown(sources_.line(file, number), start,
                          marks.empty() ? start : marks.front().begin);
    print_row(std::to_string(number), shown.text());
    for (const MarkRow& row : mark_rows(marks, shown))
      print_row("", row.text.empty() ? row.marks : fmt::format("{} {}", row.marks, row.text));
  }

  void print_row(const std::string& number, const std::string& text) {
    out_ << fmt::format("{:>{}} |{}{}\n", number, gutter_, text.empty() ? "" : " ", text);
  }

  const Diagnostic& diagnostic_;
  const SourceMap& sources_;
  std::ostream& out_;
  std::size_t gutter_ = 1;
};

bool comes_before(const Diagnostic* a, const Diagnostic* b) {
  if (!a->place || !b->place) return a->place.has_value() && !b->place.has_value();
  return std::tuple(a->place->file, a->place->begin, a->place->end) <
         std::tuple(b->place->file, b->place->begin, b->place->end);
}

void print_rest(std::size_t count, std::string_view what, std::ostream& out) {
  if (count > 0) out << fmt::format("\n… and {} more {}{}\n", count, what, count == 1 ? "" : "s");
}

}  // namespace

void render(const Diagnostics& diagnostics, const SourceMap& sources, std::ostream& out,
            std::size_t limit) {
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& diagnostic : diagnostics.all()) sorted.push_back(&diagnostic);
  std::stable_sort(sorted.begin(), sorted.end(), comes_before);

  std::size_t errors = 0;
  std::size_t warnings = 0;
  bool first = true;
  for (const Diagnostic* diagnostic : sorted) {
    std::size_t& count = diagnostic->severity == Severity::Error ? errors : warnings;
    if (++count > limit) continue;
    if (!std::exchange(first, false)) out << '\n';
    Renderer(*diagnostic, sources, out).print();
  }
  print_rest(errors > limit ? errors - limit : 0, "error", out);
  print_rest(warnings > limit ? warnings - limit : 0, "warning", out);
}

}  // namespace gmsim::support
