// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/environment.h"
#include "check/scope.h"
#include "support/source_map.h"

namespace gmsim::check {

/// A call that is being expanded; problems inside are reported at the outermost one.
struct Expansion {
  std::string name;
  Span call;
};

/// What is known while one item, or one expression outside of files, is checked in one dimension:
/// names in force, slots given out, problems found.
class ItemContext {
 public:
  ItemContext(Environment& environment, const support::SourceMap& source_map)
      : env(environment), sources(source_map) {}

  Environment& env;
  const support::SourceMap& sources;
  Scope scope;
  std::vector<std::string> slot_names;
  std::vector<double> slot_scales;  ///< SI units per unit of what a slot holds, as declared
  support::Diagnostics diagnostics;
  std::optional<support::Diagnostic> absence;
  bool poisoned = false;  ///< refers to something that was reported elsewhere

  // What the place allows.
  bool in_library = false;         ///< the text is the library's
  bool allow_all = false;          ///< `all ORBIT`
  bool allow_forces = true;        ///< force_on, forces
  ExprPtr bare_dart;               ///< a bare embedding is read here
  std::vector<Expansion> expansions;
  std::vector<std::optional<Span>>* dart_uses = nullptr;  ///< of the function checked by itself

  [[nodiscard]] int n() const { return env.dimension; }
  [[nodiscard]] bool good() const {
    return !absence && !poisoned && !diagnostics.has_errors();
  }

  Slot new_slot(const std::string& name, double scale = 1.0);
  /// Adds a local; false, and reported, when the name is taken.
  bool declare(Binding binding);
  /// Adds a local with a slot of its own and returns a reference to it.
  ExprPtr declare_slot(const syntax::Name& name, Binding::Kind kind, const types::ValueType& type,
                       const types::MaybeUnit& unit = std::nullopt, double scale = 1.0);

  void report(support::Diagnostic diagnostic);
  /// A name that is not found: silent when a broken text may hold it.
  void report_unknown(support::Diagnostic diagnostic);
  /// The item makes no sense in this dimension of the map.
  void absent(support::DiagnosticKind kind, Span place, std::string message);
  void poison() { poisoned = true; }
  /// Notes that the item needs another one; false, with the reason kept, when that one is absent or
  /// failed.
  bool require(ItemIndex item, Span place);

  /// "particles.rule:14"
  [[nodiscard]] std::string place_text(Span span) const;
};

}  // namespace gmsim::check
