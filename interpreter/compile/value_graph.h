// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "compile/match_plan.h"
#include "compile/value_program.h"

namespace gmsim::compile {

/// The instructions of a value program while it is made: equal ones are one, and what is the same
/// at all darts of an orbit is computed for one of them.
class ValueGraph {
 public:
  /// Two values belong to lanes of which neither are members of the other.
  struct LanesDiffer {};

  explicit ValueGraph(const MatchPlan& match) : match_(match) {}

  /// From now on values are for the first rows of the groups that these label positions join.
  void choose_rows(std::uint8_t positions) { chosen_ = positions; }
  /// Of those rows, one lane for each group that other positions join.
  DomainId rows(std::uint8_t joined);
  /// One lane for the whole match.
  DomainId whole() { return rows(static_cast<std::uint8_t>((1u << match_.positions) - 1)); }
  [[nodiscard]] bool is_above(DomainId above, DomainId below) const;
  /// The domain where values of both can be used. Throws LanesDiffer.
  DomainId join(DomainId a, DomainId b);
  [[nodiscard]] DomainId domain(ValueId value) const { return code_[value].domain; }
  [[nodiscard]] DomainId above(DomainId domain) const { return domains_[domain].above; }
  [[nodiscard]] const ValueInstruction& operator[](ValueId value) const { return code_[value]; }

  /// An instruction on values of domains that join; gives it the joint domain.
  ValueId add(ValueInstruction instruction);
  /// One that lists members for each lane of a domain. Its own domain is theirs.
  ValueId open(ValueInstruction instruction, DomainId above);
  /// One that makes one of the members of a domain, for the domain above.
  ValueId fold(ValueInstruction instruction, DomainId members);
  ValueId constant(std::span<const double> components);
  /// The number that a constant is; empty for anything else.
  [[nodiscard]] std::optional<double> known_number(ValueId value) const;
  /// The same value in a domain below its own. Throws LanesDiffer.
  ValueId spread(ValueId value, DomainId domain);
  /// A dart of the same orbit, one for as many lanes as possible.
  ValueId any_dart_of(OrbitType orbit, ValueId dart);

  /// The code that the outputs need.
  ValueProgram finish(std::vector<ValueProgram::Output> outputs);

 private:
  ValueId intern(const ValueInstruction& key, DomainId domain);

  const MatchPlan& match_;
  std::uint8_t chosen_ = 0;
  std::vector<LaneDomain> domains_;
  std::vector<ValueInstruction> code_;
  std::vector<double> constants_;
  std::map<ValueInstruction, ValueId> known_;
};

/// Does an instruction make a dart?
[[nodiscard]] bool makes_dart(ValueOp op);

}  // namespace gmsim::compile
