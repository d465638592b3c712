// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "compile/kernel.h"
#include "engine/force_program.h"
#include "engine/kernel/run_kernel.h"
#include "engine/match_table.h"

namespace gmsim::engine {

/// A force program for blocks of matches.
class ForceKernel {
 public:
  explicit ForceKernel(ForceProgram program);

  [[nodiscard]] const compile::Kernel& kernel() const { return kernel_; }
  [[nodiscard]] const ForceProgram& program() const { return program_; }
  /// Of kernel().inputs[k].
  [[nodiscard]] const InputOrigin& origin(std::size_t k) const { return origins_[k]; }
  /// Where the inputs of the matches of a table are. `moment` stays where it is while the bindings
  /// are used.
  void bind(const MatchTable& table, const gmap::EmbeddingStore& store, const ForceMoment& moment,
            std::vector<InputBinding>& bindings) const;

 private:
  [[nodiscard]] InputBinding binding(const InputOrigin& origin, const MatchTable& table,
                                     const gmap::EmbeddingStore& store,
                                     const ForceMoment& moment) const;

  ForceProgram program_;
  compile::Kernel kernel_;
  std::vector<InputOrigin> origins_;  // of kernel_.inputs
};

}  // namespace gmsim::engine
