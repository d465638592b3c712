// SPDX-License-Identifier: MIT
#include "scene/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "scene/schema.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Span;

struct Step {
  std::string name;
  Span span;
};

/// How an entry of a list can be called.
std::string name_of(const YamlNode& item) {
  if (item.is_scalar()) return item.text;
  if (const YamlNode* name = item.find("name"); name != nullptr && name->is_scalar())
    return name->text;
  return item.entries.size() == 1 ? item.entries[0].key : std::string();
}

/// One `--set`, on its way into the tree.
class Override {
 public:
  Override(support::FileId file, support::SourceMap& sources, Diagnostics& diagnostics)
      : file_(file), text_(sources.text(file)), sources_(sources), diagnostics_(diagnostics) {}

  void apply(YamlNode& scene) {
    if (!read_path()) return;
    const auto begin = static_cast<std::uint32_t>(equals_ + 1);
    const std::size_t errors = diagnostics_.error_count();
    YamlNode value = parse_yaml(sources_, {file_, begin, static_cast<std::uint32_t>(text_.size())},
                                diagnostics_);
    if (diagnostics_.error_count() > errors) return;
    YamlNode* place = &scene;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      place = step_into(*place, i);
      if (place == nullptr) return;
    }
    if (value.is_null()) value.span = steps_.back().span;
    *place = std::move(value);
  }

 private:
  void report(Span place, std::string message, std::string help = {}) {
    diagnostics_.report({.kind = DiagnosticKind::BadOverride,
                         .message = std::move(message),
                         .place = place,
                         .help = std::move(help)});
  }

  bool read_path() {
    equals_ = text_.find('=');
    const std::size_t end = std::min(equals_, text_.size());
    for (std::size_t at = 0; at <= end;) {
      const std::size_t next = std::min(text_.find('.', at), end);
      const auto span =
          Span{file_, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(next)};
      steps_.push_back({std::string(text_.substr(at, next - at)), span});
      at = next + 1;
    }
    const bool empty =
        std::ranges::any_of(steps_, [](const Step& step) { return step.name.empty(); });
    if (equals_ != std::string_view::npos && !empty) return true;
    report({file_, 0, static_cast<std::uint32_t>(text_.size())},
           fmt::format("`{}` is not PATH=VALUE", text_),
           "write `--set integrator.dt=1e-3` or `--set bodies.cloth.mass=0.2`");
    return false;
  }

  /// The node that step `i` leads to from `node`, made when a mapping lacks it.
  YamlNode* step_into(YamlNode& node, std::size_t i) {
    const Step& step = steps_[i];
    if (node.is_list()) return entry_of(node, step, i > 0 && steps_[i - 1].name == "bodies");
    // a mapping takes the place of a number: mass.density=10 where the scene says mass: 0.1
    if (node.is_scalar()) node = YamlNode();
    node.kind = YamlNode::Kind::Map;
    if (node.entries.empty()) node.span = step.span;
    if (YamlEntry* entry = node.find_entry(step.name)) {
      entry->key_span = step.span;
      return &entry->value;
    }
    node.entries.push_back({step.name, step.span, {}});
    return &node.entries.back().value;
  }

  YamlNode* entry_of(YamlNode& list, const Step& step, bool bodies) {
    std::vector<std::string> names;
    for (YamlNode& item : list.items) {
      names.push_back(name_of(item));
      if (bodies && !item.find("name"))
        names.back() = default_body_name(names.size() - 1, list.items.size());
      if (names.back() == step.name)
        return item.is_map() && !item.find("name") && !bodies ? &entry_with_key(item) : &item;
    }
    std::size_t number = 0;
    const auto read =
        std::from_chars(step.name.data(), step.name.data() + step.name.size(), number);
    const bool whole = read.ec == std::errc{} && read.ptr == step.name.data() + step.name.size();
    if (whole && number < list.items.size()) return &list.items[number];
    std::string help = support::did_you_mean(step.name, names);
    std::erase(names, std::string());
    if (help.empty() && !names.empty())
      help = fmt::format("entries are `{}`", fmt::join(names, "`, `"));
    report(step.span,
           whole ? fmt::format("the list has {} entries, counted from 0", list.items.size())
                 : fmt::format("no entry of this list is called `{}`", step.name),
           std::move(help));
    return nullptr;
  }

  /// The value behind the only key of an entry such as `{ vertex_drag: … }`.
  static YamlNode& entry_with_key(YamlNode& item) { return item.entries[0].value; }

  support::FileId file_;
  std::string_view text_;
  support::SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::size_t equals_ = 0;
  std::vector<Step> steps_;
};

}  // namespace

void apply_overrides(YamlNode& scene, const std::vector<std::string>& overrides,
                     support::SourceMap& sources, Diagnostics& diagnostics) {
  for (const std::string& text : overrides)
    Override(sources.add("--set", text), sources, diagnostics).apply(scene);
}

}  // namespace gmsim::scene
