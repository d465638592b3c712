// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "compile/kernel.h"

namespace gmsim::compile {

/// Rows of the value of a node.
struct PlannedOperand {
  ir::NodeId value = ir::kNone;
  std::uint8_t first_row = 0;
  std::uint8_t rows = 0;
};

/// An instruction whose registers have no place yet.
struct PlannedInstruction {
  KernelOp op{};
  ir::ValueKind type = ir::ValueKind::Real;
  ir::NodeId result = ir::kNone;  ///< kNone: a store
  std::uint8_t rows = 0;          ///< of the result
  bool uniform = false;           ///< the same for all matches: computed once a run
  std::array<PlannedOperand, 3> operands = {};
  std::array<std::uint32_t, 2> numbers = {};
  ir::Span span = {};
};

/// Gives places in the register file to values, each from the instruction that makes it to the last
/// one that reads it. An instruction may write over what it reads.
class RegisterPlan {
 public:
  void constant(ir::NodeId value, std::uint8_t rows, double number);
  void instruction(const PlannedInstruction& planned) { planned_.push_back(planned); }
  /// Writes constants, code and sizes; `block` 0: chosen here.
  void finish(std::uint32_t block, Kernel& kernel);

 private:
  struct Place {
    std::uint32_t row = 0;  // of the varying or of the uniform rows
    std::uint8_t rows = 0;
    bool uniform = false;
  };
  struct Constant {
    ir::NodeId value;
    double number;
  };

  void find_last_reads();
  void give_places();
  void release_operands(std::uint32_t position);
  std::uint32_t take_rows(std::uint8_t rows);
  [[nodiscard]] Register located(const Place& place, std::uint8_t first_row, std::uint8_t rows,
                                 const Kernel& kernel) const;
  [[nodiscard]] KernelInstruction located(const PlannedInstruction& planned,
                                          const Kernel& kernel) const;

  std::vector<PlannedInstruction> planned_;
  std::vector<Constant> constants_;
  std::unordered_map<std::uint32_t, Place> places_;             // by node
  std::unordered_map<std::uint32_t, std::uint32_t> last_read_;  // by node: position in planned_
  std::vector<bool> taken_;                                     // varying rows
  std::uint32_t uniform_rows_ = 0;
};

}  // namespace gmsim::compile
