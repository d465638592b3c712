// SPDX-License-Identifier: MIT
#include "support/scheme_text.h"

#include <cctype>
#include <stdexcept>

namespace gmsim::tests {
namespace {

using check::kBlank;
using check::LabelEntry;
using check::NodeIndex;
using check::Pattern;

class Reader {
 public:
  Reader(std::string_view text, int dimension) : text_(text) { rule_.dimension = dimension; }

  check::Rule read() {
    rule_.name = "scheme";
    side(rule_.left, true);
    rule_.has_right = accept("=>");
    if (rule_.has_right) {
      side(rule_.right, false);
    } else {
      rule_.right = rule_.left;
    }
    if (skip_space(); at_ != text_.size()) fail("unexpected text");
    pair_nodes_by_name(rule_);
    for (NodeIndex node = 0; node < rule_.left.nodes.size(); ++node) {
      rule_.left.nodes[node].slot = types::Slot{node};
      rule_.slot_names.push_back(rule_.left.nodes[node].name);
    }
    rule_.frame_size = static_cast<std::uint32_t>(rule_.left.nodes.size());
    return std::move(rule_);
  }

 private:
  void side(Pattern& pattern, bool left) {
    while (peek_name()) node(pattern, left);
    if (accept("|"))
      while (peek_name()) arc(pattern);
  }

  void node(Pattern& pattern, bool left) {
    check::PatternNode node;
    const std::size_t begin = at_;
    node.name = name();
    node.span = span(begin);
    const bool hook = left && accept("*");
    const std::size_t label = at_;
    if (!accept("<")) fail("expected <");
    while (!accept(">")) {
      node.label.push_back(accept("_") ? kBlank : static_cast<LabelEntry>(number()));
      accept(",");
    }
    node.label_span = span(label);
    if (hook) rule_.hooks.push_back(static_cast<NodeIndex>(pattern.nodes.size()));
    pattern.nodes.push_back(std::move(node));
  }

  void arc(Pattern& pattern) {
    check::PatternArc arc;
    arc.a = find(pattern);
    const std::size_t begin = at_;
    if (!accept("-")) fail("expected -");
    arc.dimension = number();
    if (!accept("-")) fail("expected -");
    arc.span = span(begin);
    arc.b = find(pattern);
    pattern.arcs.push_back(arc);
  }

  NodeIndex find(const Pattern& pattern) {
    skip_space();
    const std::string wanted = name();
    for (NodeIndex node = 0; node < pattern.nodes.size(); ++node)
      if (pattern.nodes[node].name == wanted) return node;
    fail("no node " + wanted);
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool accept(std::string_view token) {
    skip_space();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  bool peek_name() {
    skip_space();
    return at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]));
  }
  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_]))) ++at_;
    if (begin == at_) fail("expected a name");
    return std::string(text_.substr(begin, at_ - begin));
  }
  int number() {
    skip_space();
    if (at_ == text_.size() || !std::isdigit(static_cast<unsigned char>(text_[at_])))
      fail("expected a digit");
    return text_[at_++] - '0';
  }
  support::Span span(std::size_t begin) const {
    return {{}, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at_)};
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(what + " at " + std::to_string(at_) + " of: " + std::string(text_));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  check::Rule rule_;
};

std::string side_text(const Pattern& pattern, const std::vector<NodeIndex>& hooks) {
  std::string text;
  for (NodeIndex node = 0; node < pattern.nodes.size(); ++node) {
    if (!text.empty()) text += " ";
    text += pattern.nodes[node].name;
    for (const NodeIndex hook : hooks)
      if (hook == node) text += "*";
    text += "<";
    const std::vector<LabelEntry>& label = pattern.nodes[node].label;
    for (std::size_t p = 0; p < label.size(); ++p) {
      if (p > 0) text += " ";
      text += label[p] == kBlank ? "_" : std::to_string(static_cast<int>(label[p]));
    }
    text += ">";
  }
  if (!pattern.arcs.empty()) text += " |";
  for (const check::PatternArc& arc : pattern.arcs)
    text += " " + pattern.nodes[arc.a].name + "-" + std::to_string(arc.dimension) + "-" +
            pattern.nodes[arc.b].name;
  return text;
}

}  // namespace

void pair_nodes_by_name(check::Rule& rule) {
  rule.left_to_right.assign(rule.left.nodes.size(), std::nullopt);
  rule.right_to_left.assign(rule.right.nodes.size(), std::nullopt);
  for (NodeIndex l = 0; l < rule.left.nodes.size(); ++l)
    for (NodeIndex r = 0; r < rule.right.nodes.size(); ++r)
      if (rule.left.nodes[l].name == rule.right.nodes[r].name) {
        rule.left_to_right[l] = r;
        rule.right_to_left[r] = l;
      }
}

check::Rule rule_from_text(std::string_view text, int dimension) {
  return Reader(text, dimension).read();
}

std::string to_text(const check::Rule& rule) {
  std::string text = side_text(rule.left, rule.hooks);
  if (rule.has_right) text += " => " + side_text(rule.right, {});
  return text;
}

}  // namespace gmsim::tests
