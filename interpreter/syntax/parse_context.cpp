// SPDX-License-Identifier: MIT
#include "syntax/parse_context.h"

#include <fmt/format.h>

#include <algorithm>

#include "syntax/syntax_error.h"

namespace gmsim::syntax {
using support::Diagnostic;
using support::DiagnosticKind;

ParseContext::ParseContext(const support::SourceMap& sources, support::FileId file,
                           support::Diagnostics& diagnostics, RuleParser::token_kind_type start)
    : text_(sources.text(file)),
      file_(file),
      diagnostics_(diagnostics),
      scanner_(file, text_, [this](Diagnostic found) { return count_error(found); }),
      scan_error_count_(error_places_.size()),
      stream_(scanner_.tokens(), start) {}

RuleParser::symbol_type ParseContext::next_token() {
  const Token next = stream_.next();
  return {next.kind, Span{file_, next.begin, next.end}};
}

bool ParseContext::enter(DepthGuard& guard, Span after) {
  if (depth_ < kDeepestNesting) {
    guard = DepthGuard(depth_);
    return true;
  }
  const std::uint32_t begin = after.end > 0 ? after.end - 1 : 0;
  report({.kind = DiagnosticKind::TooDeep,
          .message = fmt::format("nested deeper than {} levels", kDeepestNesting),
          .place = Span{file_, begin, after.end}});
  stream_.resynchronize();
  return false;
}

ItemHead ParseContext::begin(ItemKind kind, ItemHead head) {
  item_kind_ = kind;
  return head;
}

void ParseContext::accept(Item item) {
  // Errors of the parser come in order of place, so the last one tells. One at the first word is
  // about what this item was found in.
  const bool parser_failed =
      error_places_.size() > scan_error_count_ && error_places_.back() > item.span.begin;
  if (parser_failed || has_scan_error(item.span.begin, item.span.end)) return;
  items_.push_back(std::move(item));
}

void ParseContext::report_unexpected(const ExpectedTokens& expected) {
  const Token& found = stream_.last();
  const Token* before = stream_.before_last();
  // One mistake, one message: what the scanner has already complained about often is the cause.
  const std::uint32_t from = before != nullptr ? before->begin : 0;
  const bool known = has_scan_error(from, found.end) || stream_.last_is_virtual();
  if (!known) {
    const auto& open = stream_.open_blocks();
    report(describe({.file = file_,
                     .text = text_,
                     .found = found,
                     .before = before,
                     .open_block = open.empty() ? nullptr : &open.back(),
                     .expected = expected(),
                     .item = item_kind_}));
  }
  stream_.resynchronize();
}

void ParseContext::report(Diagnostic diagnostic) {
  if (!count_error(diagnostic)) stream_.stop();
}

void ParseContext::report_too_high(Span place) {
  if (too_high_at_ == place.begin) return;
  too_high_at_ = place.begin;
  report({.kind = DiagnosticKind::TooDeep,
          .message = fmt::format("an expression of more than {} levels", kHighestTree),
          .place = place,
          .help = "name parts of it with `let`"});
}

std::string ParseContext::doc_above(const Span& item) const {
  return scanner_.doc_above(item.begin);
}

/// False when there have been too many.
bool ParseContext::count_error(const Diagnostic& diagnostic) {
  if (error_places_.size() >= kMostErrors) return false;
  error_places_.push_back(diagnostic.place ? diagnostic.place->begin : 0);
  diagnostics_.report(diagnostic);
  return error_places_.size() < kMostErrors;
}

bool ParseContext::has_scan_error(std::uint32_t begin, std::uint32_t end) const {
  const auto last = error_places_.begin() + static_cast<std::ptrdiff_t>(scan_error_count_);
  const auto found = std::lower_bound(error_places_.begin(), last, begin);
  return found != last && *found < end;
}

}  // namespace gmsim::syntax
