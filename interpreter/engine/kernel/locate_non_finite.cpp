// SPDX-License-Identifier: MIT
#include <cmath>
#include <unordered_map>

#include "engine/kernel/execute.h"
#include "engine/kernel/run_kernel.h"
#include "support/check.h"

namespace gmsim::engine {
namespace {

using compile::Kernel;
using compile::KernelInstruction;
using compile::KernelOp;
using compile::Register;

/// One match, instruction by instruction, with a record of who wrote what.
class Trace {
 public:
  Trace(const Kernel& kernel, std::span<const InputBinding> inputs, std::uint32_t match,
        double* registers)
      : kernel_(kernel), table_(baseline::op_table()) {
    frame_.registers = registers;
    frame_.row = kernel.lanes;
    frame_.active = compile::kUniformLanes;
    frame_.begin = match;
    frame_.count = 1;
    frame_.inputs = inputs.data();
    set_constants(kernel, registers);
  }

  std::optional<NonFiniteOrigin> run() {
    for (const auto* code : {&kernel_.once, &kernel_.code}) {
      for (const KernelInstruction& in : *code) {
        note_operands(in);
        if (in.d.rows == 0) {  // a store
          if (const auto culprit = steps_.back().culprit) return origin(in.numbers[0], *culprit);
          continue;
        }
        execute(in, table_, frame_);
        note_result(in);
      }
    }
    return std::nullopt;
  }

 private:
  /// `culprit`: the step of the first operand that is not finite.
  struct Step {
    const KernelInstruction* instruction = nullptr;
    std::optional<std::size_t> culprit;
  };

  [[nodiscard]] std::uint32_t step_of_row(const Register& r) const {
    return r.uniform ? compile::kUniformLanes : kernel_.lanes;
  }
  [[nodiscard]] double value(const Register& r, std::uint32_t row) const {
    return frame_.registers[r.offset + row * step_of_row(r)];
  }
  void note_operands(const KernelInstruction& in) {
    Step step{&in, {}};
    for (int k = 0; k < operand_count(in.op) && !step.culprit; ++k) {
      if (in.op == KernelOp::Select && k == (value(in.operands[0], 0) != 0 ? 2 : 1)) continue;
      const Register& r = in.operands[k];
      for (std::uint32_t row = 0; row < r.rows && !step.culprit; ++row) {
        const auto writer = writers_.find(r.offset + row * step_of_row(r));
        if (writer != writers_.end() && !std::isfinite(value(r, row)))
          step.culprit = writer->second;
      }
    }
    steps_.push_back(step);
  }
  void note_result(const KernelInstruction& in) {
    for (std::uint32_t row = 0; row < in.d.rows; ++row)
      writers_[in.d.offset + row * step_of_row(in.d)] = steps_.size() - 1;
  }
  [[nodiscard]] NonFiniteOrigin origin(std::uint32_t output, std::size_t step) const {
    while (steps_[step].culprit) step = *steps_[step].culprit;
    const KernelInstruction& in = *steps_[step].instruction;
    NonFiniteOrigin result{output, in.op, in.span, {}};
    if (in.op == KernelOp::Gather) result.input = in.numbers[0];
    if (in.op == KernelOp::GatherDifference)
      for (const std::uint32_t input : {in.numbers[1], in.numbers[0]})
        if (!finite_input(input)) result.input = input;
    return result;
  }
  [[nodiscard]] bool finite_input(std::uint32_t input) const {
    const InputBinding& in = frame_.inputs[input];
    const double* at = in.base;
    if (in.rows != nullptr) at += std::size_t(in.stride) * in.rows[frame_.begin];
    if (in.rows == nullptr && in.per_match) at += std::size_t(in.stride) * frame_.begin;
    return std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]);
  }

  const Kernel& kernel_;
  const OpTable& table_;
  BlockFrame frame_;
  std::vector<Step> steps_;
  std::unordered_map<std::uint32_t, std::size_t> writers_;  // step by offset of a row
};

}  // namespace

std::optional<NonFiniteOrigin> locate_non_finite(const Kernel& kernel,
                                                 std::span<const InputBinding> inputs,
                                                 std::uint32_t match, KernelScratch& scratch) {
  GMSIM_CHECK(inputs.size() == kernel.inputs.size(), "a kernel needs one binding for each input");
  return Trace(kernel, inputs, match, scratch.reserve(kernel.doubles)).run();
}

}  // namespace gmsim::engine
