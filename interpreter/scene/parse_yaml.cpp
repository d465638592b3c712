// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "scene/yaml_builder.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Span;

/// yaml-cpp's words for what it does not understand, in plain ones.
std::pair<std::string, std::string> in_plain_words(const std::string& problem) {
  struct Row {
    const char* theirs;
    const char* message;
    const char* help;
  };
  static constexpr Row kRows[] = {
      {"end of map flow not found", "this mapping in braces is not closed",
       "add the `}`, a comma between keys, or quotes around an expression"},
      {"end of sequence flow not found", "this list in brackets is not closed",
       "add the `]`, a comma between entries, or quotes around an expression"},
      {"end of map not found", "the keys of this mapping do not line up",
       "keys of one mapping begin in one column"},
      {"end of sequence not found", "the entries of this list do not line up",
       "the `-` of one list stand in one column"},
      {"illegal map value", "a `:` cannot stand here", "put a text that holds `: ` in quotes"},
      {"illegal map key", "a key cannot stand here", ""},
      {"illegal block entry", "a `-` cannot begin an entry here", ""},
      {"illegal flow end", "a bracket that closes nothing", ""},
      {"unknown token", "this cannot begin a value", "put the value in quotes"},
      {"bad file", "this is nested deeper than the reader allows", ""},
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
  YamlBuilder builder(text, part, diagnostics);
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
    YamlBuilder second(text, part, diagnostics);
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
