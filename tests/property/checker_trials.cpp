// SPDX-License-Identifier: MIT
#include "property/checker_trials.h"

#include "check/passes.h"
#include "support/diagnostic.h"
#include "support/rule_mutants.h"
#include "support/rule_oracle.h"
#include "support/scheme_text.h"

namespace gmsim::tests {
namespace {

using check::NodeIndex;
using check::Rule;
using support::DiagnosticKind;

constexpr int kHostsOfAccepted = 4;
/// A rejected rule counts as always valid after so many applications without a flaw.
constexpr int kEnough = 60;
constexpr int kHostsOfRejected = 150;

/// The first error, or nothing.
std::optional<DiagnosticKind> first_error(const support::Diagnostics& diagnostics) {
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    if (diagnostic.severity == support::Severity::Error) return diagnostic.kind;
  return std::nullopt;
}

/// C1 to C6: a rule that breaks them says nothing that could be done to a map.
bool ill_formed(const support::Diagnostics& diagnostics) {
  for (const support::Diagnostic& diagnostic : diagnostics.all()) switch (diagnostic.kind) {
      case DiagnosticKind::LinkDimension:
      case DiagnosticKind::DuplicateNode:
      case DiagnosticKind::LabelLength:
      case DiagnosticKind::HookLabel:
      case DiagnosticKind::HookCount:
      case DiagnosticKind::DuplicateDimension:
        return true;
      default:
        break;
    }
  return false;
}

std::string describe(const BaseRule& tried) {
  return std::to_string(tried.rule.dimension) + "D  " + to_text(tried.rule) + "   [" + tried.name +
         "]";
}

/// A rule whose only embedding lives on orbits of one type, without default or merge policy.
gmap::EmbeddingSchema one_embedding(types::OrbitType type) {
  gmap::EmbeddingSchema schema;
  gmap::EmbeddingDecl embedding;
  embedding.name = "value";
  embedding.type = {types::ValueKind::Real};
  embedding.orbit = type;
  schema.add(embedding);
  return schema;
}

/// Gives a node of `right` a value of its own: a parameter in a slot of its own.
check::Assignment assign(const Rule& rule, NodeIndex node) {
  types::Expr value{types::ExprKind::Local, {types::ValueKind::Real}, {}, {}};
  value.slot = types::Slot{rule.frame_size + node};
  check::Assignment assignment;
  assignment.node = node;
  assignment.value = std::make_shared<types::Expr>(value);
  return assignment;
}

}  // namespace

CheckerTrials::CheckerTrials(std::vector<BaseRule> sound, std::vector<BaseRule> unsound,
                             std::vector<TinyMap> maps, std::uint64_t seed)
    : sound_(std::move(sound)),
      unsound_(std::move(unsound)),
      maps_(std::move(maps)),
      random_(seed) {}

void CheckerTrials::run(long trials) {
  for (long k = 0; k < trials; ++k) trial(candidate());
}

BaseRule CheckerTrials::candidate() {
  const int dice = below(random_, 20);
  if (dice < 5) return {"random rule", random_rule(1 + below(random_, 3), random_)};
  const std::vector<BaseRule>& bases = dice < 7 && !unsound_.empty() ? unsound_ : sound_;
  const BaseRule& base =
      bases[static_cast<std::size_t>(below(random_, static_cast<int>(bases.size())))];
  Mutant mutant = mutate(base.rule, random_);
  return {base.name + ": " + mutant.how, std::move(mutant.rule)};
}

void CheckerTrials::trial(const BaseRule& tried) {
  ++counts_.trials;
  support::Diagnostics diagnostics;
  const bool good = check::check_topology(tried.rule, diagnostics);
  const std::optional<DiagnosticKind> error = first_error(diagnostics);
  if (good != !error) counts_.unsound.push_back("verdict without reason: " + describe(tried));
  if (good) {
    ++counts_.by_verdict[diagnostics.all().empty() ? "accepted" : "accepted with a warning"];
    accepted(tried);
  } else {
    const std::string kind(support::name_of(*error));
    ++counts_.by_verdict[(ill_formed(diagnostics) ? "ill-formed: " : "rejected: ") + kind];
    if (!ill_formed(diagnostics)) rejected(tried, kind);
  }
}

void CheckerTrials::accepted(const BaseRule& tried) {
  ++counts_.accepted;
  bool applied = false, broken = false;
  const auto look_at = [&](const std::optional<Application>& application) {
    if (!application) return;
    applied = true;
    ++counts_.applications;
    const std::string what = flaw(application->after.map);
    if (what.empty() || broken) return;
    broken = true;
    counts_.unsound.push_back(describe(tried) + "\n" + what + " after applying it to\n" +
                              to_string(application->before));
  };
  for (int k = 0; k < kHostsOfAccepted; ++k) look_at(apply_in_host(tried.rule, random_));
  const TinyMap& map =
      maps_[static_cast<std::size_t>(below(random_, static_cast<int>(maps_.size())))];
  if (map.dimension == tried.rule.dimension) look_at(apply_somewhere(tried.rule, map, 5, random_));
  const TinyMap degenerate = random_tiny_map(tried.rule.dimension, random_);
  look_at(apply_somewhere(tried.rule, degenerate, 10, random_));
  if (!applied || broken) return;
  ++counts_.applied;
  ++counts_.always_valid;
  ++counts_.always_valid_accepted;
  check_values(tried);
}

void CheckerTrials::rejected(const BaseRule& tried, const std::string& kind) {
  int applications = 0;
  for (int k = 0; k < kHostsOfRejected && applications < kEnough; ++k) {
    if (k == 20 && applications == 0) return;  // matches nowhere
    const std::optional<Application> application = apply_in_host(tried.rule, random_);
    if (!application) continue;
    ++applications;
    if (!flaw(application->after.map).empty()) return;
    // A rule said to match nowhere must not match.
    if (kind == support::name_of(DiagnosticKind::Conflict))
      counts_.unsound.push_back("matches after all: " + describe(tried));
  }
  if (applications < kEnough) return;
  ++counts_.always_valid;
  counts_.over_rejected[kind].push_back(describe(tried));
}

/// E1 to E4 for a random orbit type, with values for a few nodes of `right`.
void CheckerTrials::check_values(const BaseRule& tried) {
  Rule rule = tried.rule;
  const auto bits = static_cast<std::uint8_t>(below(random_, 1 << (rule.dimension + 1)));
  const types::OrbitType type = types::OrbitType::from_bits(bits);
  std::vector<NodeIndex> assigned;
  if (!rule.right.nodes.empty() && chance(random_, 0.6))
    for (int k = 1 + below(random_, 2); k > 0; --k) {
      const auto node =
          static_cast<NodeIndex>(below(random_, static_cast<int>(rule.right.nodes.size())));
      if (assigned.empty() || assigned.front() != node) assigned.push_back(node);
    }
  for (const NodeIndex node : assigned) rule.assignments.push_back(assign(rule, node));

  support::Diagnostics diagnostics;
  check::check_embeddings(rule, one_embedding(type), diagnostics);
  bool says_missing = false, says_merge = false, says_several = false;
  for (const support::Diagnostic& diagnostic : diagnostics.all()) {
    says_missing |= diagnostic.kind == DiagnosticKind::MissingValue;
    says_merge |= diagnostic.kind == DiagnosticKind::UnresolvedMerge;
    says_several |= diagnostic.kind == DiagnosticKind::SeveralValues;
  }
  ++counts_.value_checks;
  counts_.values_accepted += diagnostics.all().empty() ? 1 : 0;

  bool missing = false, several = false, apart = false;
  int applications = 0;
  const auto undecided = [&] {
    return (says_missing && !missing) || (says_merge && !several) ||
           (assigned.size() > 1 && !says_several && !apart);
  };
  for (int k = 0; k < kHostsOfRejected && (k < kHostsOfAccepted || undecided()); ++k) {
    const std::optional<Application> application = apply_in_host(rule, random_);
    if (!application) continue;
    ++applications;
    const ValueFate fate = value_fate(*application, rule, type, assigned);
    missing |= fate.missing;
    several |= fate.several;
    apart |= fate.assigned_apart;
  }
  const std::string what = types::to_string(type) + " " + describe(tried);
  if (missing && !says_missing) counts_.values_unsound.push_back("E1 on " + what);
  if (several && !says_merge) counts_.values_unsound.push_back("E3, E4 on " + what);
  if (assigned.size() > 1 && says_several && apart)
    counts_.values_unsound.push_back("E2 said of orbits apart, on " + what);
  if (applications < kEnough) return;
  if (says_missing && !missing) counts_.values_over_rejected.push_back("E1 on " + what);
  if (says_merge && !several) counts_.values_over_rejected.push_back("E3, E4 on " + what);
  if (assigned.size() > 1 && !says_several && !apart)
    counts_.values_over_rejected.push_back("E2 missed on " + what);
}

}  // namespace gmsim::tests
