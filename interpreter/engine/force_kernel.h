// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compile/kernel.h"
#include "engine/force_program.h"
#include "engine/kernel/run_kernel.h"
#include "engine/match_table.h"

namespace gmsim::engine {

/// A force program for blocks of matches.
class ForceKernel {
 public:
  /// Where a root of the program is found: vectors that are opposite, as action and reaction, share
  /// an output of the kernel.
  struct Root {
    std::uint32_t output = 0;
    bool negative = false;
  };

  explicit ForceKernel(ForceProgram program);

  [[nodiscard]] const compile::Kernel& kernel() const { return kernel_; }
  [[nodiscard]] const ForceProgram& program() const { return program_; }
  /// Of program().roots[k].
  [[nodiscard]] Root root(std::size_t k) const { return roots_[k]; }
  /// Of kernel().inputs[k].
  [[nodiscard]] const InputOrigin& origin(std::size_t k) const { return origins_[k]; }
  /// Where the inputs of the matches of a table are. `moment` stays where it is while the bindings
  /// are used.
  void bind(const MatchTable& table, const gmap::EmbeddingStore& store, const ForceMoment& moment,
            std::vector<InputBinding>& bindings) const;
  /// The same for bindings that were made before, since when table and store have not changed.
  void bind_again(const MatchTable& table, const gmap::EmbeddingStore& store,
                  const ForceMoment& moment, std::vector<InputBinding>& bindings) const;
  /// Runs the rows begin … end-1 of a table and gives the first match with a result that is not
  /// finite. What is computed of vacant rows means nothing and may be what it likes.
  std::optional<std::uint32_t> run(const MatchTable& table, std::span<const InputBinding> inputs,
                                   std::span<const OutputBinding> outputs, std::uint32_t begin,
                                   std::uint32_t end, KernelScratch& scratch) const;

 private:
  [[nodiscard]] InputBinding binding(const InputOrigin& origin, const MatchTable& table,
                                     const gmap::EmbeddingStore& store,
                                     const ForceMoment& moment) const;
  /// Fills roots_; gives the nodes to compute.
  std::vector<compile::ir::NodeId> share_opposites();

  ForceProgram program_;
  std::vector<Root> roots_;
  compile::Kernel kernel_;
  std::vector<InputOrigin> origins_;  // of kernel_.inputs
};

}  // namespace gmsim::engine
