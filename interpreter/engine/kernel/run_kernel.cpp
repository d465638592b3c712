// SPDX-License-Identifier: MIT
#include "engine/kernel/run_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/kernel/execute.h"
#include "support/check.h"

namespace gmsim::engine {
namespace {

using compile::Kernel;
using compile::KernelInstruction;
using compile::KernelOp;
using compile::Register;
using types::ValueKind;

constexpr std::string_view kIsaNames[] = {"baseline", "avx2", "avx512"};

bool has(Isa isa) {
#if defined(__x86_64__)
  switch (isa) {
    case Isa::Baseline:
      return true;
    case Isa::Avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case Isa::Avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return isa == Isa::Baseline;
}

Isa find_preferred() {
  if (const char* name = std::getenv("GMSIM_ISA"))
    for (const Isa isa : available_isas())
      if (name_of(isa) == name) return isa;
  return available_isas().back();
}

const OpTable& table_of(Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::Avx512) return avx512::op_table();
  if (isa == Isa::Avx2) return avx2::op_table();
#endif
  return baseline::op_table();
}

/// A frame in which the instructions of `once` have run, for the match `begin`.
BlockFrame prepared(const Kernel& kernel, std::span<const InputBinding> inputs,
                    std::span<const OutputBinding> outputs, std::uint32_t begin,
                    KernelScratch& scratch, const OpTable& table) {
  BlockFrame frame;
  frame.registers = scratch.reserve(kernel.doubles);
  frame.row = kernel.lanes;
  frame.inputs = inputs.data();
  frame.outputs = outputs.data();
  frame.begin = begin;
  frame.count = 1;
  frame.active = compile::kUniformLanes;
  set_constants(kernel, frame.registers);
  for (const KernelInstruction& instruction : kernel.once) execute(instruction, table, frame);
  return frame;
}

void set_block(BlockFrame& frame, std::uint32_t begin, std::uint32_t count) {
  constexpr std::uint32_t group = compile::kUniformLanes;
  frame.begin = begin;
  frame.count = count;
  frame.active = (count + group - 1) / group * group;
}

std::uint32_t rows_of(ValueKind type) {
  return type == ValueKind::Bool ? 1 : types::component_count({type, {}});
}

std::uint32_t first_non_finite(const Kernel& kernel, std::span<const OutputBinding> outputs,
                               std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t match = begin; match < end; ++match) {
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const double* value = outputs[k].base + std::size_t(outputs[k].stride) * match;
      const std::uint32_t rows = rows_of(kernel.outputs[k].type);
      if (!std::all_of(value, value + rows, [](double x) { return std::isfinite(x); }))
        return match;
    }
  }
  GMSIM_CHECK(false, "a block is not finite, but each of its matches is");
  return end;
}

}  // namespace

std::string_view name_of(Isa isa) {
  return kIsaNames[static_cast<std::size_t>(isa)];
}

std::vector<Isa> available_isas() {
  std::vector<Isa> result;
  for (const Isa isa : {Isa::Baseline, Isa::Avx2, Isa::Avx512})
    if (has(isa)) result.push_back(isa);
  return result;
}

Isa preferred_isa() {
  static const Isa preferred = find_preferred();
  return preferred;
}

double* KernelScratch::reserve(std::uint32_t count) {
  const std::size_t lines = (count + 7) / 8;
  if (lines_.size() < lines) lines_.resize(lines);
  return lines_.empty() ? nullptr : lines_.front().lanes;
}

std::optional<std::uint32_t> run_kernel(const Kernel& kernel, std::span<const InputBinding> inputs,
                                        std::span<const OutputBinding> outputs, std::uint32_t begin,
                                        std::uint32_t end, KernelScratch& scratch, Isa isa) {
  GMSIM_CHECK(inputs.size() == kernel.inputs.size() && outputs.size() == kernel.outputs.size(),
              "a kernel needs one binding for each input and output");
  if (begin >= end) return std::nullopt;
  const OpTable& table = table_of(isa);
  BlockFrame frame = prepared(kernel, inputs, outputs, begin, scratch, table);
  for (std::uint32_t first = begin; first < end; first += kernel.block) {
    set_block(frame, first, std::min(kernel.block, end - first));
    for (const KernelInstruction& instruction : kernel.code) execute(instruction, table, frame);
    if (!frame.finite) return first_non_finite(kernel, outputs, first, first + frame.count);
  }
  return std::nullopt;
}

void sum_records(const double* records, const SlotList* lists, const SignedSlot* slots,
                 std::uint32_t rows, double* out, double* inner, Isa isa) {
  table_of(isa).sum_slots(records, lists, slots, rows, out, inner);
}

void sum_shares(const double* records, const SlotList* lists, const SlotShare* shares,
                std::uint32_t rows, double* out, Isa isa) {
  table_of(isa).sum_shares(records, lists, shares, rows, out);
}

}  // namespace gmsim::engine
