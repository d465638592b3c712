// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "check/checked_rule.h"
#include "support/tiny_map.h"

/// The checker's promise, put to the test: no rule that it accepts breaks a map or leaves an orbit
/// without exactly one value, and it rejects nothing that never does.
namespace gmsim::tests {

/// A rule to start from, or to change.
struct BaseRule {
  std::string name;
  check::Rule rule;
};

/// How often the checker and the oracle agreed, and what they disagreed about.
struct TrialCounts {
  long trials = 0;
  std::map<std::string, long> by_verdict;  ///< "accepted", "rejected: incident-arcs", …
  long accepted = 0;
  long applied = 0;       ///< accepted and applied at least once
  long applications = 0;  ///< of accepted rules
  long always_valid = 0;  ///< mutants and random rules that never broke a map
  long always_valid_accepted = 0;
  std::vector<std::string> unsound;
  std::map<std::string, std::vector<std::string>> over_rejected;  ///< by kind of diagnostic

  long value_checks = 0;  ///< orbit types of accepted rules that were looked at
  long values_accepted = 0;
  std::vector<std::string> values_unsound;
  std::vector<std::string> values_over_rejected;
};

class CheckerTrials {
 public:
  CheckerTrials(std::vector<BaseRule> sound, std::vector<BaseRule> unsound,
                std::vector<TinyMap> maps, std::uint64_t seed);

  void run(long trials);
  [[nodiscard]] const TrialCounts& counts() const { return counts_; }

 private:
  BaseRule candidate();
  void trial(const BaseRule& tried);
  void accepted(const BaseRule& tried);
  void rejected(const BaseRule& tried, const std::string& kind);
  void check_values(const BaseRule& tried);

  std::vector<BaseRule> sound_, unsound_;
  std::vector<TinyMap> maps_;
  Random random_;
  TrialCounts counts_;
};

}  // namespace gmsim::tests
