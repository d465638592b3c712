// SPDX-License-Identifier: MIT
#pragma once

#include "check/normal_form.h"
#include "check/orbit_classes.h"
#include "support/diagnostic.h"

namespace gmsim::check {

/// E6: the value that a rule gives to an orbit is the same at every row that the orbit joins.
class InvarianceChecker {
 public:
  InvarianceChecker(const Rule& rule, const KnownLinks& links, const gmap::EmbeddingSchema& schema);

  /// Reports the first position among `joined` that changes the assignment's value.
  bool check(const Assignment& assignment, Positions joined, support::Diagnostics& diagnostics);
  /// Two expressions are the same value at every match, as far as NormalForms can tell.
  [[nodiscard]] bool equal(const types::Expr& a, const types::Expr& b) {
    return forms_.of(a) == forms_.of(b);
  }

 private:
  void report(const Assignment& assignment, std::uint8_t position,
              support::Diagnostics& diagnostics) const;

  const Rule& rule_;
  const KnownLinks& links_;
  const gmap::EmbeddingSchema& schema_;
  NormalForms forms_;
};

/// "vertex", "edge", …, or "orbit <0,3>".
[[nodiscard]] std::string orbit_in_words(types::OrbitType type, int dimension);

}  // namespace gmsim::check
