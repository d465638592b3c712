// SPDX-License-Identifier: MIT
#include "check/item_table.h"

#include <algorithm>
#include <array>

#include "check/item_parts.h"
#include "types/builtin.h"

namespace gmsim::check {
using support::Diagnostic;
using support::DiagnosticKind;
namespace {

/// Calls with a syntax or a reading of their own; see types/builtins.def for the others.
constexpr std::array kForms = {"sum",    "mean",     "min",    "max",    "count", "any",
                               "all",    "argmax",   "argmin", "has",    "free",  "random",
                               "forces", "force_on", "grad",   "frozen", "polygon"};

bool overlap(const ItemEntry& a, const ItemEntry& b) {
  return !a.dimension || !b.dimension || *a.dimension == *b.dimension;
}

}  // namespace

std::string_view noun(ItemKind kind) {
  switch (kind) {
    case ItemKind::Orbit: return "orbit";
    case ItemKind::Embedding: return "embedding";
    case ItemKind::Derived: return "derived value";
    case ItemKind::Function: return "function";
    case ItemKind::Pattern: return "pattern";
    case ItemKind::Rule: return "rule";
    case ItemKind::Interaction: return "interaction";
    case ItemKind::Family: return "family";
    case ItemKind::Criterion: return "criterion";
    case ItemKind::Operation: return "operation";
  }
  return {};
}

std::string with_article(ItemKind kind) {
  const std::string word(noun(kind));
  return (std::string_view("aeio").find(word[0]) == std::string_view::npos ? "a " : "an ") + word;
}

NameSpace name_space(ItemKind kind) {
  switch (kind) {
    case ItemKind::Orbit: return NameSpace::Orbits;
    case ItemKind::Embedding:
    case ItemKind::Derived:
    case ItemKind::Interaction:
    case ItemKind::Family: return NameSpace::Values;
    case ItemKind::Function: return NameSpace::Functions;
    case ItemKind::Pattern: return NameSpace::Patterns;
    case ItemKind::Rule: return NameSpace::Rules;
    case ItemKind::Criterion: return NameSpace::Criteria;
    case ItemKind::Operation: return NameSpace::Operations;
  }
  return NameSpace::Values;
}

ItemTable::ItemTable(const LoadedRules& rules, support::Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < rules.files.size(); ++i)
    add_file(rules.files[i], rules.info[i], i, diagnostics);
}

void ItemTable::add_file(const syntax::RuleFile& file, const LoadedFile& info,
                         std::size_t position, support::Diagnostics& diagnostics) {
  const DimensionChoice whole_file = file_dimension(file, diagnostics);
  for (const syntax::Item& item : file.items) {
    const auto part = item_name(item);
    if (!part) continue;
    const DimensionChoice own = item_dimension(item, whole_file, diagnostics);
    add({part->first, &item, part->second, position, info.library, own.dimension}, diagnostics);
  }
}

void ItemTable::add(ItemEntry entry, support::Diagnostics& diagnostics) {
  if (!accept_word(entry, diagnostics) || !accept(entry, diagnostics)) return;
  by_name_[{name_space(entry.kind), entry.name->text}].push_back(entries_.size());
  entries_.push_back(entry);
}

bool ItemTable::accept_word(const ItemEntry& entry, support::Diagnostics& diagnostics) const {
  const bool called = entry.kind == ItemKind::Function || entry.kind == ItemKind::Orbit;
  const bool builtin = called && is_builtin_word(entry.name->text);
  const bool orbit = entry.kind == ItemKind::Function && is_predeclared_orbit(entry.name->text);
  if (!builtin && !orbit) return true;
  diagnostics.report({.kind = DiagnosticKind::DuplicateName,
                      .message = "`" + entry.name->text + "` is " +
                                 (builtin ? "a builtin function" : "a predeclared orbit"),
                      .place = entry.name->span,
                      .help = "choose another name"});
  return false;
}

/// Two items of one name space cannot have one name; nor can two kinds that the same words use.
bool ItemTable::accept(const ItemEntry& entry, support::Diagnostics& diagnostics) const {
  const NameSpace own = name_space(entry.kind);
  std::vector<NameSpace> spaces = {own};
  if (own == NameSpace::Rules) spaces.push_back(NameSpace::Operations);   // `apply x(a)`
  if (own == NameSpace::Operations) spaces.push_back(NameSpace::Rules);
  if (own == NameSpace::Functions) spaces.push_back(NameSpace::Orbits);   // `x(a)`
  if (own == NameSpace::Orbits) spaces.push_back(NameSpace::Functions);
  for (const NameSpace space : spaces) {
    const auto bucket = by_name_.find({space, entry.name->text});
    if (bucket == by_name_.end()) continue;
    for (const ItemIndex i : bucket->second) {
      const ItemEntry& other = entries_[i];
      if (!overlap(entry, other)) continue;
      if (space == own && other.library && !entry.library) {
        diagnostics.report({.kind = DiagnosticKind::Shadowing,
                            .message = "`" + entry.name->text + "` takes the place of the library's " +
                                       std::string(noun(other.kind)),
                            .place = entry.name->span,
                            .related = {{other.name->span, "the library's"}},
                            .severity = support::Severity::Warning});
        continue;
      }
      diagnostics.report({.kind = DiagnosticKind::DuplicateName,
                          .message = "`" + entry.name->text + "` is already " +
                                     with_article(other.kind),
                          .place = entry.name->span,
                          .related = {{other.name->span, "first declared here"}}});
      return false;
    }
  }
  return true;
}

std::optional<ItemIndex> ItemTable::find(NameSpace space, const std::string& name,
                                         int dimension, bool from_library) const {
  const bool expanded = space == NameSpace::Functions || space == NameSpace::Patterns;
  const bool prefer_library = from_library && expanded;
  const auto bucket = by_name_.find({space, name});
  if (bucket == by_name_.end()) return std::nullopt;
  std::optional<ItemIndex> found;
  for (const ItemIndex i : bucket->second) {
    const ItemEntry& entry = entries_[i];
    if (entry.dimension && *entry.dimension != dimension) continue;
    if (!found || (entries_[*found].library != entry.library && entry.library == prefer_library))
      found = i;
  }
  return found;
}

std::optional<ItemIndex> ItemTable::find_any(NameSpace space, const std::string& name) const {
  const auto bucket = by_name_.find({space, name});
  return bucket == by_name_.end() ? std::nullopt : std::optional(bucket->second.back());
}

bool ItemTable::active(ItemIndex i, int dimension) const {
  const ItemEntry& entry = entries_[i];
  const auto meant = find(name_space(entry.kind), entry.name->text, dimension);
  return !meant || *meant == i;
}

std::vector<std::string> ItemTable::names(NameSpace space) const {
  std::vector<std::string> names;
  for (const auto& [key, bucket] : by_name_)
    if (key.first == space) names.push_back(key.second);
  return names;
}

std::vector<OrbitName> predeclared_orbits(int n) {
  std::vector<OrbitName> orbits = {
      {"dart", OrbitType{}, "One dart."},
      {"vertex", OrbitType::cell(0, n), "A vertex: every link but 0."},
      {"edge", OrbitType::cell(1, n), "An edge: every link but 1."}};
  if (n >= 2) orbits.push_back({"face", OrbitType::cell(2, n), "A face: every link but 2."});
  if (n >= 3) orbits.push_back({"volume", OrbitType::cell(3, n), "A volume: every link but 3."});
  OrbitType facet = OrbitType::range(0, n - 2);
  facet.insert(n);
  orbits.push_back({"component", OrbitType::range(0, n), "A connected component."});
  orbits.push_back({"element", OrbitType::range(0, n - 1), "A cell of the highest dimension."});
  orbits.push_back({"corner", OrbitType::range(1, n - 1), "A vertex inside one element."});
  orbits.push_back({"facet", facet, "What two elements share: an edge in 2D, a face in 3D."});
  orbits.push_back({"halffacet", OrbitType::range(0, n - 2), "A facet seen from one element."});
  orbits.push_back({"halfedge", OrbitType{0}, "Two darts linked by 0."});
  return orbits;
}

bool is_predeclared_orbit(std::string_view word) {
  // The highest dimension has them all.
  static const std::vector<OrbitName> orbits = predeclared_orbits(types::kMaxDimension);
  return std::ranges::find(orbits, word, &OrbitName::name) != orbits.end();
}

bool is_builtin_word(std::string_view word) {
  return std::ranges::find(kForms, word) != kForms.end() || types::builtin(word).has_value();
}

std::vector<std::string> builtin_words() {
  std::vector<std::string> words(kForms.begin(), kForms.end());
  for (const types::BuiltinInfo& info : types::builtins()) words.emplace_back(info.name);
  return words;
}

}  // namespace gmsim::check
