// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "scene/yaml_tree.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Span;

/// Nodes that aliases may copy in all: a few lines could otherwise stand for any number of them.
constexpr std::size_t kAliasBudget = 100'000;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

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
    if (quote == '"' && source[at] == '\\') ++at;
    else if (source[at] != quote) continue;
    else if (quote == '\'' && at + 1 < source.size() && source[at + 1] == '\'') ++at;
    else return at;
  }
  return source.size();
}

std::size_t count_nodes(const YamlNode& node) {
  std::size_t count = 1;
  for (const YamlNode& item : node.items) count += count_nodes(item);
  for (const YamlEntry& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

/// Builds the tree from yaml-cpp's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string_view text, Span part, Diagnostics& diagnostics)
      : text_(text), part_(part), diagnostics_(diagnostics) {}

  [[nodiscard]] YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode node;
    const std::size_t at = offset(mark);
    const bool written = at < text_.size() && (text_[at] == '~' || text_[at] == 'n' ||
                                               text_[at] == 'N');
    node.span = span(at, written ? word_end(at) : at);
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
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

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    YamlNode node = YamlNode::scalar(value, {});
    place(node, offset(mark), tag == "!");
    add(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::List, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::Map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::optional<YamlEntry> key;
    std::unordered_map<std::string, Span> seen;
  };

  [[nodiscard]] std::size_t offset(const YAML::Mark& mark) const {
    return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), text_.size());
  }
  [[nodiscard]] Span span(std::size_t begin, std::size_t end) const {
    return {part_.file, part_.begin + static_cast<std::uint32_t>(begin),
            part_.begin + static_cast<std::uint32_t>(end)};
  }
  [[nodiscard]] std::size_t word_end(std::size_t at) const {
    while (at < text_.size() && !is_space(text_[at]) &&
           std::string_view(",]}").find(text_[at]) == std::string_view::npos)
      ++at;
    return at;
  }

  void complain(Span place, std::string message, std::string help = {}) {
    diagnostics_.report({.kind = DiagnosticKind::YamlSyntax,
                         .message = std::move(message),
                         .place = place,
                         .help = std::move(help)});
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    const std::size_t at = offset(mark);
    complain(span(at, word_end(at)), "tags such as `!!str` mean nothing in a scene",
             "leave the tag out; quotes make a text");
  }

  /// Finds the bytes of a scalar. Where they do not spell its value (escapes), the span is the whole.
  void place(YamlNode& node, std::size_t begin, bool quoted) {
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
      if (first == '"' || first == '\'') end = closing_quote(text_, content, first);
      else end = std::min(text_.find('\n', content), text_.size());
    }
    node.span = span(content, std::max(content, end));
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    Open level;
    level.node.kind = kind;
    level.node.span = span(offset(mark), offset(mark));
    level.anchor = anchor;
    open_.push_back(std::move(level));
  }

  void close() {
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

  /// A flow list or mapping ends with its bracket.
  void close_bracket(Span& whole) const {
    const std::size_t begin = whole.begin - part_.begin;
    const char first = begin < text_.size() ? text_[begin] : ' ';
    if (first != '[' && first != '{') return;
    std::size_t at = std::max<std::size_t>(whole.end - part_.begin, begin + 1);
    while (at < text_.size() && (is_space(text_[at]) || text_[at] == ',' || text_[at] == '"' ||
                                 text_[at] == '\''))
      ++at;
    const bool closed = at < text_.size() && text_[at] == (first == '[' ? ']' : '}');
    whole.end = part_.begin + static_cast<std::uint32_t>(closed ? at + 1 : whole.end - part_.begin);
    whole.end = std::max(whole.end, whole.begin + 1);
  }

  void add(YamlNode node, YAML::anchor_t anchor) {
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

  void add_key(const YamlNode& node) {
    if (!node.is_scalar()) complain(node.span, "a key is a word, this is " + describe(node));
    open_.back().key = YamlEntry{node.text, node.span, {}};
  }

  void add_value(YamlNode node) {
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

  std::string_view text_;
  Span part_;
  Diagnostics& diagnostics_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
  std::size_t aliased_ = 0;
};

/// yaml-cpp's words for what it does not understand, in plain ones.
std::pair<std::string, std::string> in_plain_words(const std::string& problem) {
  struct Row {
    const char* theirs;
    const char* message;
    const char* help;
  };
  static constexpr Row kRows[] = {
      {"end of map flow not found", "this mapping in braces is not closed", "add the `}`, a comma between keys, or quotes around an expression"},
      {"end of sequence flow not found", "this list in brackets is not closed", "add the `]`, a comma between entries, or quotes around an expression"},
      {"end of map not found", "the keys of this mapping do not line up", "keys of one mapping begin in one column"},
      {"end of sequence not found", "the entries of this list do not line up", "the `-` of one list stand in one column"},
      {"illegal map value", "a `:` cannot stand here", "put a text that holds `: ` in quotes"},
      {"illegal map key", "a key cannot stand here", ""},
      {"illegal block entry", "a `-` cannot begin an entry here", ""},
      {"illegal flow end", "a bracket that closes nothing", ""},
      {"unknown token", "this cannot begin a value", "put the value in quotes"},
      {"the referenced anchor is not defined", "no anchor has this name", ""}};
  for (const Row& row : kRows)
    if (problem.starts_with(row.theirs)) return {row.message, row.help};
  return {"this is not YAML: " + problem, ""};
}

/// YAML forbids tabs in indentation; yaml-cpp's complaint comes late and elsewhere.
bool tabs_reported(std::string_view text, Span part, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t content = std::min(text.find_first_not_of(" \t", line), text.size());
    const std::size_t tab = text.substr(0, content).find('\t', line);
    const bool blank = content == text.size() || text[content] == '\n' || text[content] == '\r' ||
                       text[content] == '#';
    if (tab != std::string_view::npos && !blank) {
      const auto at = part.begin + static_cast<std::uint32_t>(tab);
      diagnostics.report({.kind = DiagnosticKind::YamlSyntax,
                          .message = "a tab in the indentation",
                          .place = Span{part.file, at, at + 1},
                          .help = "indent with spaces"});
    }
    const std::size_t end = text.find('\n', content);
    line = end == std::string_view::npos ? text.size() : end + 1;
  }
  return diagnostics.error_count() > errors;
}

bool control_characters_reported(std::string_view text, Span part, Diagnostics& diagnostics) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto c = static_cast<unsigned char>(text[at]);
    if (c >= 0x20 || c == '\t' || c == '\n' || c == '\r') continue;
    const auto place = part.begin + static_cast<std::uint32_t>(at);
    diagnostics.report({.kind = DiagnosticKind::YamlSyntax,
                        .message = "a control character; a scene is UTF-8 text",
                        .place = Span{part.file, place, place + 1}});
    return true;
  }
  return false;
}

}  // namespace

YamlNode parse_yaml(const support::SourceMap& sources, Span part, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(part);
  if (control_characters_reported(text, part, diagnostics)) return {};
  if (tabs_reported(text, part, diagnostics)) return {};
  std::istringstream stream{std::string(text)};
  TreeBuilder builder(text, part, diagnostics);
  const auto report = [&](const YAML::Mark& mark, const std::string& message,
                          const std::string& help) {
    const auto at = static_cast<std::uint32_t>(
        std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), text.size()));
    diagnostics.report({.kind = DiagnosticKind::YamlSyntax,
                        .message = message,
                        .place = Span{part.file, part.begin + at, part.begin + at + 1},
                        .help = help});
  };
  try {
    YAML::Parser parser(stream);
    const bool found = parser.HandleNextDocument(builder);
    YamlNode root = builder.take();
    TreeBuilder second(text, part, diagnostics);
    if (found && parser.HandleNextDocument(second))
      diagnostics.report({.kind = DiagnosticKind::YamlSyntax,
                          .message = "a second document begins here; a scene is one",
                          .place = second.take().span});
    return root;
  } catch (const YAML::Exception& problem) {
    const auto [message, help] = in_plain_words(problem.msg);
    report(problem.mark, message, help);
    return {};
  }
}

}  // namespace gmsim::scene
