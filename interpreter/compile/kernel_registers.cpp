// SPDX-License-Identifier: MIT
#include "compile/kernel_registers.h"

#include <algorithm>

namespace gmsim::compile {
namespace {

/// Short programs live from the first-level cache; long ones from fewer turns through their code.
std::uint32_t chosen_block(std::size_t instructions) {
  return instructions <= 60 ? 64 : 256;
}

}  // namespace

void RegisterPlan::constant(ir::NodeId value, std::uint8_t rows, double number) {
  places_[index(value)] = {uniform_rows_, rows, true};
  uniform_rows_ += rows;
  constants_.push_back({value, number});
}

void RegisterPlan::finish(std::uint32_t block, Kernel& kernel) {
  find_last_reads();
  give_places();
  kernel.block = block != 0 ? block : chosen_block(planned_.size());
  kernel.lanes = (kernel.block + kUniformLanes - 1) / kUniformLanes * kUniformLanes;
  kernel.doubles =
      static_cast<std::uint32_t>(taken_.size()) * kernel.lanes + uniform_rows_ * kUniformLanes;
  for (const Constant& constant : constants_) {
    const Place& place = places_.at(index(constant.value));
    kernel.constants.push_back({located(place, 0, place.rows, kernel), constant.number});
  }
  for (const PlannedInstruction& planned : planned_)
    (planned.uniform ? kernel.once : kernel.code).push_back(located(planned, kernel));
}

void RegisterPlan::find_last_reads() {
  for (std::uint32_t i = 0; i < planned_.size(); ++i)
    for (const PlannedOperand& operand : planned_[i].operands)
      if (operand.value != ir::kNone) last_read_[index(operand.value)] = i;
}

void RegisterPlan::give_places() {
  for (std::uint32_t i = 0; i < planned_.size(); ++i) {
    const PlannedInstruction& planned = planned_[i];
    if (!planned.uniform) release_operands(i);
    if (planned.result == ir::kNone) continue;
    Place place{.rows = planned.rows, .uniform = planned.uniform};
    if (planned.uniform) {
      place.row = uniform_rows_;
      uniform_rows_ += planned.rows;
    } else {
      place.row = take_rows(planned.rows);
    }
    places_[index(planned.result)] = place;
  }
}

void RegisterPlan::release_operands(std::uint32_t position) {
  for (const PlannedOperand& operand : planned_[position].operands) {
    if (operand.value == ir::kNone || last_read_.at(index(operand.value)) != position) continue;
    const Place& place = places_.at(index(operand.value));
    if (!place.uniform) std::fill_n(taken_.begin() + place.row, place.rows, false);
  }
}

/// The first gap of that many rows.
std::uint32_t RegisterPlan::take_rows(std::uint8_t rows) {
  std::size_t first = 0;
  for (std::size_t row = 0; row < taken_.size() && row < first + rows; ++row)
    if (taken_[row]) first = row + 1;
  if (first + rows > taken_.size()) taken_.resize(first + rows, false);
  std::fill_n(taken_.begin() + static_cast<std::ptrdiff_t>(first), rows, true);
  return static_cast<std::uint32_t>(first);
}

Register RegisterPlan::located(const Place& place, std::uint8_t first_row, std::uint8_t rows,
                               const Kernel& kernel) const {
  const std::uint32_t row = place.row + first_row;
  const std::uint32_t varying = static_cast<std::uint32_t>(taken_.size()) * kernel.lanes;
  const std::uint32_t offset = place.uniform ? varying + row * kUniformLanes : row * kernel.lanes;
  return {offset, rows, place.uniform};
}

KernelInstruction RegisterPlan::located(const PlannedInstruction& planned,
                                        const Kernel& kernel) const {
  KernelInstruction result;
  result.op = planned.op;
  result.type = planned.type;
  result.numbers[0] = planned.numbers[0];
  result.numbers[1] = planned.numbers[1];
  result.span = planned.span;
  if (planned.result != ir::kNone)
    result.d = located(places_.at(index(planned.result)), 0, planned.rows, kernel);
  for (std::size_t k = 0; k < planned.operands.size(); ++k) {
    const PlannedOperand& operand = planned.operands[k];
    if (operand.value != ir::kNone)
      result.operands[k] =
          located(places_.at(index(operand.value)), operand.first_row, operand.rows, kernel);
  }
  return result;
}

}  // namespace gmsim::compile
