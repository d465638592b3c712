// SPDX-License-Identifier: MIT
#include "scene/yaml_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Span;

/// Nodes that aliases may copy in all: a few lines could otherwise stand for any number of them.
constexpr std::size_t kAliasBudget = 100'000;

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Where in `source`, from `begin` on, the text of a scalar ends; empty when the bytes do not spell
/// it. Runs of white space match each other: lines of a scalar are folded.
std::optional<std::size_t> spelled_end(std::string_view source, std::size_t begin,
                                       std::string_view text) {
  std::size_t at = begin, i = 0;
  while (i < text.size()) {
    if (is_space(text[i])) {
      if (at >= source.size() || !is_space(source[at])) return std::nullopt;
      while (i < text.size() && is_space(text[i])) ++i;
      if (i == text.size()) return at;
      while (at < source.size() && is_space(source[at])) ++at;
    } else {
      if (at >= source.size() || source[at] != text[i]) return std::nullopt;
      ++at, ++i;
    }
  }
  return at;
}

/// The place after the quote that closes the scalar opened before `begin`.
std::size_t closing_quote(std::string_view source, std::size_t begin, char quote) {
  for (std::size_t at = begin; at < source.size(); ++at) {
    if (quote == '"' && source[at] == '\\')
      ++at;
    else if (source[at] != quote)
      continue;
    else if (quote == '\'' && at + 1 < source.size() && source[at + 1] == '\'')
      ++at;
    else
      return at;
  }
  return source.size();
}

std::size_t count_nodes(const YamlNode& node) {
  std::size_t count = 1;
  for (const YamlNode& item : node.items) count += count_nodes(item);
  for (const YamlEntry& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

}  // namespace

void YamlBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  YamlNode node;
  const std::size_t at = offset(mark);
  const bool written =
      at < text_.size() && (text_[at] == '~' || text_[at] == 'n' || text_[at] == 'N');
  node.span = span(at, written ? word_end(at) : at);
  add(std::move(node), anchor);
}

void YamlBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const std::size_t at = offset(mark);
  const auto known = anchors_.find(anchor);
  if (known == anchors_.end()) {
    complain(span(at, word_end(at)), "this alias stands for a value that holds it");
    add({}, YAML::NullAnchor);
    return;
  }
  aliased_ += count_nodes(known->second);
  if (aliased_ > kAliasBudget) {
    complain(span(at, word_end(at)), "aliases stand for more values than fit");
    add({}, YAML::NullAnchor);
    return;
  }
  add(known->second, YAML::NullAnchor);
}

void YamlBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  refuse_tag(mark, tag);
  YamlNode node = YamlNode::scalar(value, {});
  place(node, offset(mark), tag == "!");
  add(std::move(node), anchor);
}

std::size_t YamlBuilder::offset(const YAML::Mark& mark) const {
  return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), text_.size());
}

Span YamlBuilder::span(std::size_t begin, std::size_t end) const {
  return {part_.file, part_.begin + static_cast<std::uint32_t>(begin),
          part_.begin + static_cast<std::uint32_t>(end)};
}

std::size_t YamlBuilder::word_end(std::size_t at) const {
  while (at < text_.size() && !is_space(text_[at]) &&
         std::string_view(",]}").find(text_[at]) == std::string_view::npos)
    ++at;
  return at;
}

void YamlBuilder::complain(Span place, std::string message, std::string help) {
  diagnostics_.report({.kind = DiagnosticKind::YamlSyntax,
                       .message = std::move(message),
                       .place = place,
                       .help = std::move(help)});
}

void YamlBuilder::refuse_tag(const YAML::Mark& mark, const std::string& tag) {
  if (tag.empty() || tag == "?" || tag == "!") return;
  const std::size_t at = offset(mark);
  complain(span(at, word_end(at)), "tags such as `!!str` mean nothing in a scene",
           "leave the tag out; quotes make a text");
}

void YamlBuilder::place(YamlNode& node, std::size_t begin, bool quoted) {
  node.plain = !quoted;
  const char first = begin < text_.size() ? text_[begin] : ' ';
  std::size_t content = begin;
  if (quoted && (first == '"' || first == '\'')) {
    content = begin + 1;
    if (closing_quote(text_, content, first) == text_.size())
      complain(span(begin, content), "this text in quotes is not closed");
  } else if (quoted && (first == '|' || first == '>')) {
    content = std::min(text_.find('\n', begin), text_.size());
    while (content < text_.size() && is_space(text_[content])) ++content;
  }
  std::size_t end = text_.size();
  if (const auto spelled = spelled_end(text_, content, node.text)) {
    end = *spelled;
  } else {
    node.exact = false;
    if (first == '"' || first == '\'')
      end = closing_quote(text_, content, first);
    else
      end = std::min(text_.find('\n', content), text_.size());
  }
  node.span = span(content, std::max(content, end));
}

void YamlBuilder::open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                       YAML::anchor_t anchor) {
  refuse_tag(mark, tag);
  Open level;
  level.node.kind = kind;
  level.node.span = span(offset(mark), offset(mark));
  level.anchor = anchor;
  open_.push_back(std::move(level));
}

void YamlBuilder::close() {
  Open level = std::move(open_.back());
  open_.pop_back();
  Span& whole = level.node.span;
  if (!level.node.items.empty()) whole.end = std::max(whole.end, level.node.items.back().span.end);
  for (const YamlEntry& entry : level.node.entries) {
    whole.begin = std::min(whole.begin, entry.key_span.begin);
    whole.end = std::max({whole.end, entry.key_span.end, entry.value.span.end});
  }
  close_bracket(whole);
  add(std::move(level.node), level.anchor);
}

void YamlBuilder::close_bracket(Span& whole) const {
  const std::size_t begin = whole.begin - part_.begin;
  const char first = begin < text_.size() ? text_[begin] : ' ';
  if (first != '[' && first != '{') return;
  std::size_t at = std::max<std::size_t>(whole.end - part_.begin, begin + 1);
  while (at < text_.size() &&
         (is_space(text_[at]) || text_[at] == ',' || text_[at] == '"' || text_[at] == '\''))
    ++at;
  const bool closed = at < text_.size() && text_[at] == (first == '[' ? ']' : '}');
  whole.end = part_.begin + static_cast<std::uint32_t>(closed ? at + 1 : whole.end - part_.begin);
  whole.end = std::max(whole.end, whole.begin + 1);
}

void YamlBuilder::add(YamlNode node, YAML::anchor_t anchor) {
  if (anchor != YAML::NullAnchor) anchors_[anchor] = node;
  if (open_.empty()) {
    root_ = std::move(node);
  } else if (open_.back().node.is_list()) {
    open_.back().node.items.push_back(std::move(node));
  } else if (!open_.back().key) {
    add_key(node);
  } else {
    add_value(std::move(node));
  }
}

void YamlBuilder::add_key(const YamlNode& node) {
  if (!node.is_scalar()) complain(node.span, "a key is a word, this is " + describe(node));
  open_.back().key = YamlEntry{node.text, node.span, {}};
}

void YamlBuilder::add_value(YamlNode node) {
  Open& level = open_.back();
  YamlEntry entry = std::move(*level.key);
  level.key.reset();
  entry.value = std::move(node);
  if (entry.value.is_null() && entry.value.span.empty()) entry.value.span = entry.key_span;
  const auto [first, fresh] = level.seen.emplace(entry.key, entry.key_span);
  if (fresh) {
    level.node.entries.push_back(std::move(entry));
    return;
  }
  diagnostics_.report({.kind = DiagnosticKind::DuplicateKey,
                       .message = fmt::format("the key `{}` stands here twice", entry.key),
                       .place = entry.key_span,
                       .related = {{first->second, "it has a value already"}}});
}

}  // namespace gmsim::scene
