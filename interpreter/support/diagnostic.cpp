// SPDX-License-Identifier: MIT
#include "support/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gmsim::support {
namespace {

/// Two diagnostics are the same message exactly when their keys are equal.
std::string key_of(const Diagnostic& diagnostic) {
  const int kind = static_cast<int>(diagnostic.kind);
  if (!diagnostic.place) return fmt::format("{}||{}", kind, diagnostic.message);
  const Span& at = *diagnostic.place;
  return fmt::format("{}|{},{},{}|{}", kind, static_cast<std::uint32_t>(at.file), at.begin, at.end,
                     diagnostic.message);
}

}  // namespace

const std::vector<DiagnosticKindInfo>& diagnostic_kinds() {
  static const std::vector<DiagnosticKindInfo> kinds = {
#define DIAGNOSTIC(id, name, doc) {DiagnosticKind::id, name, doc},
#include "support/diagnostic_kinds.def"
#undef DIAGNOSTIC
  };
  return kinds;
}

std::string_view name_of(DiagnosticKind kind) {
  return diagnostic_kinds().at(static_cast<std::size_t>(kind)).name;
}

bool Diagnostics::report(Diagnostic diagnostic) {
  if (!seen_.insert(key_of(diagnostic)).second) return false;
  if (diagnostic.severity == Severity::Error) ++error_count_;
  diagnostics_.push_back(std::move(diagnostic));
  return true;
}

void Diagnostics::rewind(std::size_t count) {
  while (diagnostics_.size() > count) {
    const Diagnostic& last = diagnostics_.back();
    if (last.severity == Severity::Error) --error_count_;
    seen_.erase(key_of(last));
    diagnostics_.pop_back();
  }
}

}  // namespace gmsim::support
