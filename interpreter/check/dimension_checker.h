// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "check/item_checks.h"

namespace gmsim::check {

/// Checks all items in one dimension of the map. The passes run in the order of `passes()`; what each
/// finds is kept by item in the environment.
class DimensionChecker {
 public:
  DimensionChecker(Environment& environment, const LoadedRules& files,
                   const support::SourceMap& sources)
      : env_(environment), files_(files), sources_(sources) {}

  struct Pass {
    std::string_view name;
    void (DimensionChecker::*run)();
  };
  /// In order; each pass relies on those before it.
  [[nodiscard]] static const std::vector<Pass>& passes();
  void run();

 private:
  // passes
  void mark_other_dimensions();
  void check_orbits();
  void check_patterns();
  void check_values();
  void check_functions();
  void check_rules();
  void check_operations();
  void check_criteria();  ///< after the rules and operations that they apply

  // one round of check_values
  void declare_values();
  void complete_values();
  void declare_families();
  [[nodiscard]] bool round_is_final() const;
  void reset_values();

  void check_operation_after_its_parts(ItemIndex item, int depth);
  [[nodiscard]] const InteractionDraft* draft_of(const syntax::Name& name, ItemContext& context);
  [[nodiscard]] std::vector<ItemIndex> unchecked(ItemKind kind) const;
  [[nodiscard]] ItemContext context_for(ItemIndex item) const;
  void keep(ItemIndex item, ItemContext& context);
  void leave_unfitting(ItemIndex item);

  Environment& env_;
  const LoadedRules& files_;
  const support::SourceMap& sources_;
  std::vector<std::unique_ptr<InteractionDraft>> drafts_;
  std::vector<EmbeddingId> first_values_;  ///< of the drafts: the presence mark in the schema
  std::vector<std::pair<ItemIndex, EmbeddingId>> declared_;  ///< embeddings and derived values
};

}  // namespace gmsim::check
