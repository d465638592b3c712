// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/yaml_tree.h"

namespace gmsim::scene {

/// Builds a tree from yaml-cpp's events; `text` is what is parsed, `part` its place.
class YamlBuilder : public YAML::EventHandler {
 public:
  YamlBuilder(std::string_view text, support::Span part, support::Diagnostics& diagnostics)
      : text_(text), part_(part), diagnostics_(diagnostics) {}

  [[nodiscard]] YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
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
  /// A list or mapping that is not at its end.
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::optional<YamlEntry> key;
    std::unordered_map<std::string, support::Span> seen;
  };

  [[nodiscard]] std::size_t offset(const YAML::Mark& mark) const;
  [[nodiscard]] support::Span span(std::size_t begin, std::size_t end) const;
  [[nodiscard]] std::size_t word_end(std::size_t at) const;
  void complain(support::Span place, std::string message, std::string help = {});
  void refuse_tag(const YAML::Mark& mark, const std::string& tag);
  /// Finds the bytes of a scalar. Where they do not spell its value (escapes), the span is the
  /// whole.
  void place(YamlNode& node, std::size_t begin, bool quoted);
  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor);
  void close();
  /// A flow list or mapping ends with its bracket.
  void close_bracket(support::Span& whole) const;
  void add(YamlNode node, YAML::anchor_t anchor);
  void add_key(const YamlNode& node);
  void add_value(YamlNode node);

  std::string_view text_;
  support::Span part_;
  support::Diagnostics& diagnostics_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
  std::size_t aliased_ = 0;
};

}  // namespace gmsim::scene
