// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "check/check.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::check_tests {

/// A text checked by itself after a small set of particles, without the standard library.
struct CheckedText {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  check::CheckedRules rules;
  support::FileId file{};

  /// The diagnostics as a user sees them; empty when there are none.
  [[nodiscard]] std::string messages() const;
  /// `--dump checked` of the text in one dimension, footprints left out.
  [[nodiscard]] std::string dump(int dimension) const;
  /// "unit-mismatch|5 [s]" for each error: kind and the text under its caret.
  [[nodiscard]] std::vector<std::string> errors() const;
};

/// The particles that texts may refer to.
[[nodiscard]] const std::string& particles();
[[nodiscard]] CheckedText check_text(const std::string& text, bool with_particles = true);

/// An expression in the notation of checked expressions; "error: …" with the messages otherwise.
[[nodiscard]] std::string checked_expression(const CheckedText& rules, int dimension,
                                             const std::string& text);

}  // namespace gmsim::check_tests
