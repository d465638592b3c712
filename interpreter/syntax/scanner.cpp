// SPDX-License-Identifier: MIT
#include "syntax/scanner.h"

#include <fmt/format.h>

#include <algorithm>

namespace gmsim::syntax {
namespace {

using support::DiagnosticKind;
using token = RuleParser::token;

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Length of the UTF-8 sequence that begins a text; 0 for a zero byte or what is no UTF-8.
std::uint32_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
  const unsigned lead = byte(0);
  if (lead == 0) return 0;
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return follows(1) ? 2 : 0;
  if (lead >= 0xe0 && lead < 0xf0) {
    const bool overlong = lead == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = lead == 0xed && byte(1) >= 0xa0;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xf0 && lead < 0xf5) {
    const bool out_of_range = (lead == 0xf0 && byte(1) < 0x90) || (lead == 0xf4 && byte(1) >= 0x90);
    return follows(1) && follows(2) && follows(3) && !out_of_range ? 4 : 0;
  }
  return 0;
}

std::string help_for(std::string_view character) {
  if (character == "&&") return "the word is `and`";
  if (character == "||") return "the word is `or`";
  if (character == "!") return "the word is `not`";
  if (character == "#") return "a comment begins with `//`";
  if (character == "\u2212" || character == "\u2013") return "the minus sign is `-`";
  if (character == "\u00b7" || character == "\u00d7") return "the multiplication sign is `*`";
  return {};
}

}  // namespace

bool is_word(RuleParser::token_kind_type kind) {
  return kind == token::NAME || (kind >= token::TOP && kind <= token::ALL);
}

bool is_reserved(RuleParser::token_kind_type kind) {
  return kind >= token::TOP && kind <= token::IMPORT;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return std::string(text);
  return std::string(text.substr(0, kLongest)) + "…";
}

Scanner::Scanner(support::FileId file, std::string_view text, Report report)
    : file_(file), text_(text), report_(std::move(report)) {
  if (text_.starts_with(kByteOrderMark)) advance(static_cast<int>(kByteOrderMark.size()));
  tokens_.reserve(text_.size() / 4);
  run(text_.substr(end_));
  advance(0);
  stopped_ = false;
  add(token::END);
}

std::string Scanner::doc_above(std::uint32_t begin) const {
  const auto found =
      std::lower_bound(docs_.begin(), docs_.end(), begin,
                       [](const auto& doc, std::uint32_t offset) { return doc.first < offset; });
  return found != docs_.end() && found->first == begin ? found->second : std::string{};
}

void Scanner::advance(int length) {
  begin_ = end_;
  end_ += static_cast<std::uint32_t>(length);
}

void Scanner::add(RuleParser::token_kind_type kind) {
  if (stopped_) return;
  if (!pending_doc_.empty()) docs_.emplace_back(begin_, std::exchange(pending_doc_, {}));
  const bool in_first_column = begin_ == 0 || text_[begin_ - 1] == '\n';
  tokens_.push_back({kind, begin_, end_, first_on_line_, in_first_column});
  first_on_line_ = false;
}

void Scanner::doc_line() {
  if (!check_bytes()) return;
  std::string_view line = matched().substr(3);
  line = line.substr(0, line.find_last_not_of(" \t\r\f\v") + 1);
  if (line.starts_with(' ')) line.remove_prefix(1);
  pending_doc_ += line;
  pending_doc_ += '\n';
}

void Scanner::comment() {
  check_bytes();
  if (matched().find('\n') != std::string_view::npos) first_on_line_ = true;
}

void Scanner::open_comment() {
  report(DiagnosticKind::UnterminatedComment, {file_, begin_, begin_ + 2},
         "this comment is never closed", "close it with `*/`");
}

void Scanner::bad_number() {
  report(DiagnosticKind::BadNumber, place(),
         fmt::format("`{}` is neither a number nor a name", shortened(matched())));
  add(token::REAL);
}

void Scanner::string() {
  check_bytes();
  add(token::STRING);
}

void Scanner::bad_string() {
  if (check_bytes())
    report(DiagnosticKind::Syntax, place(), "unknown escape in a string",
           "a backslash is written `\\\\` and a quotation mark `\\\"`");
  add(token::STRING);
}

void Scanner::open_string() {
  report(DiagnosticKind::UnterminatedComment, {file_, begin_, begin_ + 1},
         "this string is never closed", "close it with `\"` on the same line");
  add(token::STRING);
}

void Scanner::bad_character() {
  if (!check_bytes()) return;
  const std::string_view text = matched();
  const bool multi_byte = static_cast<unsigned char>(text[0]) >= 0x80;
  const std::string_view shown = multi_byte ? text.substr(0, sequence_length(text)) : text;
  const auto end = begin_ + static_cast<std::uint32_t>(shown.size());
  const bool control =
      !multi_byte && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f);
  report(DiagnosticKind::BadCharacter, {file_, begin_, end},
         control ? fmt::format("unexpected control character 0x{:02x}", text[0])
                 : fmt::format("unexpected character `{}`", shown),
         help_for(shown));
}

void Scanner::report(support::DiagnosticKind kind, Span place, std::string message,
                     std::string help) {
  if (stopped_) return;
  support::Diagnostic diagnostic{.kind = kind, .message = std::move(message), .place = place};
  diagnostic.help = std::move(help);
  stopped_ = !report_(std::move(diagnostic));
}

bool Scanner::check_bytes() {
  const std::string_view text = matched();
  for (std::uint32_t i = 0; i < text.size();) {
    const std::uint32_t length = sequence_length(text.substr(i));
    if (length == 0) {
      const auto byte = static_cast<unsigned char>(text[i]);
      report(DiagnosticKind::BadCharacter, {file_, begin_ + i, begin_ + i + 1},
             byte == 0 ? "a zero byte" : fmt::format("the byte 0x{:02x} is not UTF-8", byte));
      return false;
    }
    i += length;
  }
  return true;
}

}  // namespace gmsim::syntax
