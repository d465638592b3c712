// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/load_rules.h"
#include "support/diagnostic.h"
#include "syntax/ast.h"

namespace gmsim::check {

enum class ItemKind {
  Orbit, Embedding, Derived, Function, Pattern, Rule, Interaction, Family, Criterion, Operation
};
/// "orbit", "embedding", "derived value", …
[[nodiscard]] std::string_view noun(ItemKind kind);
/// "a rule", "an operation", …
[[nodiscard]] std::string with_article(ItemKind kind);

/// Kinds of one name space: embeddings, derived values, interactions and families share the one
/// after `.`.
enum class NameSpace { Orbits, Values, Functions, Patterns, Rules, Criteria, Operations };
[[nodiscard]] NameSpace name_space(ItemKind kind);

/// A declared item; it may be valid in several dimensions of the map.
struct ItemEntry {
  ItemKind kind;
  const syntax::Item* item = nullptr;
  const syntax::Name* name = nullptr;
  std::size_t file = 0;          ///< position in LoadedRules
  bool library = false;
  std::optional<int> dimension;  ///< says `dimension k;`, in its body or in its file
};

using ItemIndex = std::size_t;

/// Every item of the loaded files by name. Reports duplicates, shadowed library names and
/// contradictory `dimension` statements.
class ItemTable {
 public:
  ItemTable(const LoadedRules& rules, support::Diagnostics& diagnostics);

  [[nodiscard]] const std::vector<ItemEntry>& entries() const { return entries_; }
  [[nodiscard]] const ItemEntry& operator[](ItemIndex i) const { return entries_[i]; }
  /// The item meant by a name in one dimension; a user's before the library's. Texts of the library
  /// (`from_library`) keep the library's own functions and patterns, which are expanded in place.
  [[nodiscard]] std::optional<ItemIndex> find(NameSpace space, const std::string& name,
                                              int dimension, bool from_library = false) const;
  /// Whether there is an item of this name in some dimension, for the wording of messages.
  [[nodiscard]] std::optional<ItemIndex> find_any(NameSpace space, const std::string& name) const;
  /// Whether the item is the one that its name means in a user's text.
  [[nodiscard]] bool active(ItemIndex i, int dimension) const;
  [[nodiscard]] std::vector<std::string> names(NameSpace space) const;

 private:
  void add(ItemEntry entry, support::Diagnostics& diagnostics);
  void add_file(const syntax::RuleFile& file, const LoadedFile& info, std::size_t position,
                support::Diagnostics& diagnostics);
  bool accept(const ItemEntry& entry, support::Diagnostics& diagnostics) const;
  bool accept_word(const ItemEntry& entry, support::Diagnostics& diagnostics) const;

  std::vector<ItemEntry> entries_;
  std::map<std::pair<NameSpace, std::string>, std::vector<ItemIndex>> by_name_;
};

/// The orbits that every file knows in a map of this dimension.
[[nodiscard]] std::vector<OrbitName> predeclared_orbits(int dimension);
/// In some dimension.
[[nodiscard]] bool is_predeclared_orbit(std::string_view word);
/// A word such as `sum`, `has` or `norm` that a call already has a meaning for.
[[nodiscard]] bool is_builtin_word(std::string_view word);
/// All of them, for suggestions.
[[nodiscard]] std::vector<std::string> builtin_words();

}  // namespace gmsim::check
