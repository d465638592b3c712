// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "compile/rewrite_plan.h"
#include "types/builtin.h"
#include "types/value_type.h"

/// The values of a rule as a flat program: plain data made by compile_values, executed by
/// engine::ValueMachine.
///
/// A value is computed for several *lanes* at once. The lanes of the outermost domains are rows of
/// the match; a fold opens a domain with a lane for each member of its collection, of all lanes of
/// the domain above one after the other.
namespace gmsim::compile {

using ValueId = std::uint32_t;  ///< number of an instruction, and of its result
using DomainId = std::uint32_t;

enum class ValueOp : std::uint8_t {
#define VALUE_OP(id, meaning) id,
#include "compile/value_ops.def"
#undef VALUE_OP
};

/// What the lanes of values stand for.
struct LaneDomain {
  static constexpr DomainId kNone = 0xffffffffu;
  DomainId above = kNone;  ///< kNone: rows of the match
  /// Rows: of the groups of rows that the label positions `chosen` join the first ones, and of
  /// those again one for each group that the positions in `joined` join. A bit for each position.
  std::uint8_t chosen = 0, joined = 0;
  ValueId opened_by = kNone;  ///< else the instruction that lists the members
};

struct ValueInstruction {
  ValueOp op{};
  std::uint32_t count = 1;  ///< components of the result
  DomainId domain = 0;      ///< of the result
  std::array<ValueId, 3> args{LaneDomain::kNone, LaneDomain::kNone, LaneDomain::kNone};
  std::int32_t number = 0;
  EmbeddingId embedding = {};
  OrbitType orbit = {};
  OrbitType inner = {};
  types::Builtin builtin = {};
  types::ValueKind left = {}, right = {};  ///< Product: kinds of the operands

  auto operator<=>(const ValueInstruction&) const = default;
};

struct ValueProgram {
  /// The value of an assignment, at the rows of the domain.
  struct Output {
    std::uint32_t assignment = 0;
    ValueId value = 0;
  };
  /// False: a value needs what lanes cannot express; evaluate the trees.
  bool complete = true;
  std::vector<LaneDomain> domains = {};
  std::vector<ValueInstruction> code = {};
  std::vector<double> constants = {};
  std::vector<Output> outputs = {};
};

}  // namespace gmsim::compile
