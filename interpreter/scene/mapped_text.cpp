// SPDX-License-Identifier: MIT
#include "scene/mapped_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <utility>

#include "types/value.h"

namespace gmsim::scene {
namespace {

using support::Span;
using types::ExprPtr;

bool digit(char c) {
  return c >= '0' && c <= '9';
}

/// Length of the number that `text` begins with, as YAML writes it: `+1`, `.5` and `2.` too.
std::size_t number_length(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t first = at;
  while (at < text.size() && digit(text[at])) ++at;
  std::size_t digits = at - first;
  if (at < text.size() && text[at] == '.') {
    const std::size_t fraction = ++at;
    while (at < text.size() && digit(text[at])) ++at;
    digits += at - fraction;
  }
  if (digits == 0) return 0;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '-' || text[exponent] == '+')) ++exponent;
    const std::size_t begin = exponent;
    while (exponent < text.size() && digit(text[exponent])) ++exponent;
    if (exponent > begin) at = exponent;
  }
  return at;
}

/// The rule language wants a digit on both sides of the dot and no plus sign.
bool written_alike(std::string_view number) {
  const std::size_t dot = number.find('.');
  if (number[0] == '+') return false;
  if (dot == std::string_view::npos) return true;
  return dot > 0 && digit(number[dot - 1]) && dot + 1 < number.size() && digit(number[dot + 1]);
}

}  // namespace

std::optional<NumberAndUnit> split_quantity(std::string_view text) {
  const std::size_t length = number_length(text);
  if (length == 0) return std::nullopt;
  std::size_t unit = length;
  while (unit < text.size() && text[unit] == ' ') ++unit;
  if (unit == text.size()) return NumberAndUnit{text.substr(0, length), {}, text.size()};
  const bool apart = unit > length;
  const auto first = static_cast<unsigned char>(text[unit]);
  const bool over = text.substr(unit).starts_with("1/");
  // `1e` and `2x` are no numbers with a unit; `0 or …` and `2 * x` are expressions
  if (!apart || !(std::isalpha(first) != 0 || over)) return std::nullopt;
  for (const char* word : {"and ", "or ", "then ", "else ", "in "})
    if (text.substr(unit).starts_with(word)) return std::nullopt;
  return NumberAndUnit{text.substr(0, length), text.substr(unit), unit};
}

void MappedText::append(std::string_view text, Span source, bool exact) {
  pieces_.push_back({static_cast<std::uint32_t>(text_.size()), source, exact});
  text_ += text;
}

void MappedText::append_scalar(const support::SourceMap& sources, const YamlNode& node) {
  const auto quantity = split_quantity(node.text);
  if (!quantity) {
    // the bytes themselves, so that lines of a folded scalar keep their places
    append(node.exact ? sources.text(node.span) : std::string_view(node.text), node.span,
           node.exact);
    return;
  }
  const bool exact = node.exact && sources.text(node.span) == node.text;
  const auto part = [&](std::size_t begin, std::size_t end) {
    if (!exact) return node.span;
    return Span{node.span.file, node.span.begin + static_cast<std::uint32_t>(begin),
                node.span.begin + static_cast<std::uint32_t>(end)};
  };
  const std::size_t length = quantity->number.size();
  if (written_alike(quantity->number)) {
    append(quantity->number, part(0, length), exact);
  } else {
    const double value = std::strtod(std::string(quantity->number).c_str(), nullptr);
    append(types::number_text(value), part(0, length), false);
  }
  if (quantity->unit.empty()) return;
  append(" [", part(quantity->unit_begin, quantity->unit_begin), false);
  append(quantity->unit, part(quantity->unit_begin, node.text.size()), exact);
  append("]", part(node.text.size(), node.text.size()), false);
}

MappedText MappedText::of_value(const support::SourceMap& sources, const YamlNode& node) {
  MappedText result;
  if (node.is_scalar()) {
    result.append_scalar(sources, node);
    return result;
  }
  const Span end{node.span.file, node.span.end, node.span.end};
  result.append("(", {node.span.file, node.span.begin, node.span.begin}, false);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0)
      result.append(", ", {end.file, node.items[i].span.begin, node.items[i].span.begin}, false);
    result.append_scalar(sources, node.items[i]);
  }
  result.append(")", end, false);
  return result;
}

MappedText MappedText::of_span(const support::SourceMap& sources, Span span) {
  MappedText result;
  result.append(sources.text(span), span, true);
  return result;
}

support::FileId MappedText::add_to(support::SourceMap& sources, std::string name) {
  file_ = sources.add(std::move(name), text_);
  return file_;
}

std::uint32_t MappedText::place(std::uint32_t offset, bool end) const {
  // the end of a span belongs to the piece that holds its last byte
  const std::uint32_t holder = end && offset > 0 ? offset - 1 : offset;
  const auto after = std::ranges::upper_bound(pieces_, holder, {}, &Piece::begin);
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *std::prev(after);
  if (!piece.exact) return end ? piece.source.end : piece.source.begin;
  return std::min(piece.source.begin + (offset - piece.begin), piece.source.end);
}

Span MappedText::map(Span span) const {
  if (span.file != file_ || pieces_.empty()) return span;
  const std::uint32_t begin = place(span.begin, false);
  return {pieces_.front().source.file, begin,
          std::max(begin, place(span.end, span.end > span.begin))};
}

support::Diagnostic MappedText::map(support::Diagnostic diagnostic) const {
  if (diagnostic.place) diagnostic.place = map(*diagnostic.place);
  for (support::Label& label : diagnostic.related) label.span = map(label.span);
  return diagnostic;
}

void MappedText::report(const support::Diagnostics& found,
                        support::Diagnostics& diagnostics) const {
  for (const support::Diagnostic& diagnostic : found.all()) diagnostics.report(map(diagnostic));
}

namespace {

/// Copies an expression with other spans. Memory of what is copied keeps sharing.
template <typename MapSpan>
class Respan {
 public:
  explicit Respan(MapSpan map) : map_(std::move(map)) {}

  ExprPtr operator()(const ExprPtr& expr) {
    if (!expr) return expr;
    const auto known = known_.find(expr.get());
    if (known != known_.end()) return known->second;
    const Span span = map_(expr->span);
    std::vector<ExprPtr> args;
    for (const ExprPtr& arg : expr->args) args.push_back((*this)(arg));
    ExprPtr result = expr;
    if (!(span == expr->span) || args != expr->args) {
      auto copy = std::make_shared<types::Expr>(*expr);
      copy->span = span;
      copy->args = std::move(args);
      result = std::move(copy);
    }
    known_.emplace(expr.get(), result);
    return result;
  }

 private:
  MapSpan map_;
  std::unordered_map<const types::Expr*, ExprPtr> known_;
};

}  // namespace

ExprPtr MappedText::map(const ExprPtr& expr) const {
  return Respan([this](Span span) { return map(span); })(expr);
}

}  // namespace gmsim::scene
