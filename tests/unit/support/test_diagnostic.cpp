// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "support/diagnostic.h"

using namespace gmsim::support;

namespace {

Diagnostic error_at(std::uint32_t begin, std::string message) {
  return {.kind = DiagnosticKind::Syntax,
          .message = std::move(message),
          .place = Span{FileId{0}, begin, begin + 1}};
}

}  // namespace

TEST_CASE("kinds have distinct names in lower case and an explanation") {
  std::set<std::string_view> names;
  for (const DiagnosticKindInfo& row : diagnostic_kinds()) {
    INFO(row.name);
    CHECK(names.insert(row.name).second);
    CHECK(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string_view::npos);
    CHECK(row.doc.ends_with('.'));
    CHECK(name_of(row.kind) == row.name);
  }
}

TEST_CASE("a message reported twice counts once") {
  Diagnostics diagnostics;
  CHECK(diagnostics.report(error_at(3, "x")));
  CHECK_FALSE(diagnostics.report(error_at(3, "x")));
  CHECK(diagnostics.report(error_at(4, "x")));
  CHECK(diagnostics.report(error_at(3, "y")));
  CHECK(diagnostics.report({.kind = DiagnosticKind::Syntax, .message = "x"}));
  CHECK(diagnostics.error_count() == 4);
}

TEST_CASE("warnings are no errors") {
  Diagnostics diagnostics;
  diagnostics.report(
      {.kind = DiagnosticKind::Shadowing, .message = "x", .severity = Severity::Warning});
  CHECK_FALSE(diagnostics.has_errors());
  CHECK(diagnostics.all().size() == 1);
}

TEST_CASE("rewind forgets what came later, so that it can be reported again") {
  Diagnostics diagnostics;
  diagnostics.report(error_at(1, "kept"));
  diagnostics.report(error_at(2, "tried"));
  diagnostics.report(
      {.kind = DiagnosticKind::Shadowing, .message = "w", .severity = Severity::Warning});
  diagnostics.rewind(1);
  CHECK(diagnostics.error_count() == 1);
  CHECK(diagnostics.all().size() == 1);
  CHECK_FALSE(diagnostics.report(error_at(1, "kept")));
  CHECK(diagnostics.report(error_at(2, "tried")));
}
