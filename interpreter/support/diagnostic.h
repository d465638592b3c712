// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "support/source_map.h"
#include "support/span.h"

namespace gmsim::support {

/// Every kind of message a user can get; the rows live in diagnostic_kinds.def.
enum class DiagnosticKind {
#define DIAGNOSTIC(id, name, doc) id,
#include "support/diagnostic_kinds.def"
#undef DIAGNOSTIC
};

/// What a kind is called in messages, `incident-arcs`, and the paragraph that explains it.
struct DiagnosticKindInfo {
  DiagnosticKind kind;
  std::string_view name;
  std::string_view doc;
};
[[nodiscard]] const std::vector<DiagnosticKindInfo>& diagnostic_kinds();
[[nodiscard]] std::string_view name_of(DiagnosticKind kind);

enum class Severity { Error, Warning };

/// A second place that explains the first, underlined with dashes.
struct Label {
  Span span;
  std::string text;
};

/// One message to the user. A diagnostic without a place (bad command line, run-time error of a
/// rule-less job) leaves `place` empty.
struct Diagnostic {
  DiagnosticKind kind;
  std::string message;
  std::optional<Span> place = std::nullopt;
  std::vector<Label> related = {};
  std::vector<std::string> notes = {};
  std::string help = {};
  Severity severity = Severity::Error;
};

/// Collects the diagnostics of a run. A message that is reported again (kind, place, text) counts
/// once, so a check may run for each dimension of the map.
class Diagnostics {
 public:
  /// Returns false when an equal message was reported before.
  bool report(Diagnostic diagnostic);
  [[nodiscard]] bool has_errors() const { return error_count_ > 0; }
  [[nodiscard]] std::size_t error_count() const { return error_count_; }
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return diagnostics_; }
  /// Forget everything reported after `count` (used to try a check and take it back).
  void rewind(std::size_t count);

 private:
  std::vector<Diagnostic> diagnostics_;
  std::unordered_set<std::string> seen_;
  std::size_t error_count_ = 0;
};

/// Prints in order of file and position (messages without a place last), with source lines, carets
/// under the place and dashes under what explains it; at most `limit` errors and as many warnings.
void render(const Diagnostics& diagnostics, const SourceMap& sources, std::ostream& out,
            std::size_t limit = 20);

}  // namespace gmsim::support
