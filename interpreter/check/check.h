// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "check/checked_rule.h"
#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/ast.h"

namespace gmsim::check {

/// Where rule texts come from.
struct LibraryOptions {
  /// Read the standard library from this folder instead of the texts packed into the program.
  std::filesystem::path stdlib_folder = {};
  /// The library's files to bring in; empty: all of them.
  std::vector<std::string> modules = {};
  bool with_stdlib = true;
  /// The only dimension whose rules will be asked for; 0: any. What users write is checked in all of
  /// them nevertheless; without such files the other dimensions stay empty.
  int dimension = 0;
  /// Rules that make sense but are rejected for what they do to maps or values stay in the result,
  /// to show what they do. They are reported all the same.
  bool keep_rejected = false;
};

struct Checking;

/// The checked rules of a run, for every dimension of the map. An item that makes no sense in a
/// dimension (it names `volume`, or says `dimension 3;`) is absent there.
class CheckedRules {
 public:
  [[nodiscard]] const RuleLibrary& in(int dimension) const { return *libraries_.at(dimension - 1); }
  /// Why an item is absent in a dimension; empty when it is there or is not known at all.
  [[nodiscard]] std::string why_absent(const std::string& item, int dimension) const;
  /// Every parsed file, the library's first.
  [[nodiscard]] const std::vector<syntax::RuleFile>& files() const { return files_; }

 private:
  friend class RuleChecker;
  std::array<std::unique_ptr<RuleLibrary>, 3> libraries_;
  std::vector<syntax::RuleFile> files_;
  std::vector<std::pair<std::string, std::array<std::string, 3>>> absent_;
  /// Names and functions, for expressions that are checked later. It refers to the trees in `files_`,
  /// so the rules can be moved but not copied.
  std::shared_ptr<Checking> checking_;
};

/// Parses and checks the library and the given files with what they import. Several errors a run;
/// the result holds every item without errors.
[[nodiscard]] CheckedRules check_rules(const std::vector<std::filesystem::path>& files,
                                       const LibraryOptions& options,
                                       support::SourceMap& sources,
                                       support::Diagnostics& diagnostics);

/// The same for texts already in `sources` (tests, fuzzing, inline rules).
[[nodiscard]] CheckedRules check_texts(const std::vector<support::FileId>& texts,
                                       const LibraryOptions& options,
                                       support::SourceMap& sources,
                                       support::Diagnostics& diagnostics);

/// An expression outside of rule files: `a` is the dart at hand, and a bare embedding `x` is `a.x`.
struct CheckedExpression {
  ExprPtr value;  ///< null after an error
  Slot dart{};
  std::uint32_t frame_size = 1;
  std::vector<std::string> slot_names;
};
/// Checks it against the library of one dimension and the type wanted (Error kind: any type).
[[nodiscard]] CheckedExpression check_expression(const CheckedRules& rules, int dimension,
                                                 support::FileId text,
                                                 const types::ValueType& wanted,
                                                 support::SourceMap& sources,
                                                 support::Diagnostics& diagnostics);

/// What an expression outside of rule files is for, when its unit matters.
struct WantedValue {
  types::ValueType type;                       ///< Error kind: any type
  types::MaybeUnit unit = std::nullopt;        ///< must agree when both are known
  double unit_scale = 1.0;                     ///< bare numbers are multiples of this many SI units
};
[[nodiscard]] CheckedExpression check_value_expression(const CheckedRules& rules, int dimension,
                                                       support::FileId text,
                                                       const WantedValue& wanted,
                                                       support::SourceMap& sources,
                                                       support::Diagnostics& diagnostics);

/// `--dump checked`.
void dump_checked(const RuleLibrary& library, support::FileId file, std::ostream& out);

}  // namespace gmsim::check
