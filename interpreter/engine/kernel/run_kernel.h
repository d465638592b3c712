// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "compile/kernel.h"

/// Running register programs over the rows of a match table.
namespace gmsim::engine {

/// Where the values of one input are. That of match m starts
///   at base[stride * rows[m]]  when `rows` is given,
///   at base[stride * m]        when `per_match`,
///   at base[0]                 else: the same for all matches (uniform parameters, time, dt,
///   step).
/// A vec3 in records of 4 doubles (stride 4, base at a multiple of 32 bytes, VertexRecord) is read
/// fastest; the fourth number is read and ignored.
struct InputBinding {
  const double* base = nullptr;
  std::uint32_t stride = 0;
  const std::uint32_t* rows = nullptr;
  bool per_match = false;
};

/// The value of match m goes to base[stride * m]. A vec3 with stride 4 is written as a whole record
/// with w = 0. Masks are stored as 0 or 1.
struct OutputBinding {
  double* base = nullptr;
  std::uint32_t stride = 0;
};

/// Instruction sets that the operations are compiled for. All give the same bits.
enum class Isa : std::uint8_t { Baseline, Avx2, Avx512 };
[[nodiscard]] std::string_view name_of(Isa isa);
/// Those of this machine, Baseline first.
[[nodiscard]] std::vector<Isa> available_isas();
/// The widest one that helps here, or the one that the environment variable GMSIM_ISA names
/// (`baseline`, `avx2`, `avx512`) when the machine has it.
[[nodiscard]] Isa preferred_isa();

/// The register file of one thread; grows to what the programs need.
class KernelScratch {
 public:
  /// At least `count` doubles, at a multiple of 64 bytes.
  [[nodiscard]] double* reserve(std::uint32_t count);

 private:
  struct alignas(64) Line {
    double lanes[8];
  };
  std::vector<Line> lines_;
};

/// Runs a program for the matches begin … end-1: `inputs` has one binding per kernel.inputs,
/// `outputs` one per kernel.outputs. Gives the first match with an output that is not finite.
std::optional<std::uint32_t> run_kernel(const compile::Kernel& kernel,
                                        std::span<const InputBinding> inputs,
                                        std::span<const OutputBinding> outputs, std::uint32_t begin,
                                        std::uint32_t end, KernelScratch& scratch,
                                        Isa isa = preferred_isa());

/// Where a number that is not finite came from: the operation whose operands are all finite, or an
/// input.
struct NonFiniteOrigin {
  std::uint32_t output = 0;  ///< which root is not finite
  compile::KernelOp op{};
  support::Span span;                  ///< of the expression in the rule
  std::optional<std::uint32_t> input;  ///< index into kernel.inputs when it was read as such
};

/// Runs one match again and finds the origin; empty when all its outputs are finite.
[[nodiscard]] std::optional<NonFiniteOrigin> locate_non_finite(const compile::Kernel& kernel,
                                                               std::span<const InputBinding> inputs,
                                                               std::uint32_t match,
                                                               KernelScratch& scratch);

}  // namespace gmsim::engine
