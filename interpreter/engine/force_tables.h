// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/force_kernel.h"
#include "engine/force_merge.h"
#include "engine/match_set.h"

namespace gmsim::engine {

/// The kernels of one shape. Those that a step does not need are made when they are first asked for.
class ShapeKernels {
 public:
  ShapeKernels(const compile::Shape& shape, const ShapeInputs& inputs)
      : shape_(shape), inputs_(inputs), program_(force_program(shape, inputs)) {}

  /// Of the forces.
  [[nodiscard]] const ForceProgram& program() const { return program_; }
  [[nodiscard]] const ForceKernel& force();
  [[nodiscard]] const ForceKernel& product();
  // Without a root (a shape without energy): null.
  [[nodiscard]] const ForceKernel* energy() { return made(energy_, energy_program); }
  [[nodiscard]] const ForceKernel* direction() { return made(direction_, direction_program); }

 private:
  using Make = ForceProgram(const compile::Shape&, const ShapeInputs&);
  struct Lazy {
    bool asked = false;
    std::unique_ptr<ForceKernel> kernel;
  };
  const ForceKernel* made(Lazy& lazy, Make& make);

  const compile::Shape& shape_;
  const ShapeInputs& inputs_;
  ForceProgram program_;
  std::unique_ptr<ForceKernel> force_, product_;
  Lazy energy_, direction_;
};

/// The matches of one interaction at work with their kernels, and where matches merge the merged form
/// of their table.
class InteractionTables {
 public:
  using Place = MatchSet::Place;
  static constexpr std::uint32_t kNowhere = MatchSet::kNowhere;

  InteractionTables(const ForceContext& context, std::uint32_t number, bool merge);

  /// Finds all matches anew.
  std::optional<support::Diagnostic> rebuild();
  /// As in MatchSet.
  std::optional<support::Diagnostic> find_at(DartId dart, std::optional<DartId>& key);
  /// Brings the matches of all tables into the order of their keys, without vacant rows, and merges
  /// them again.
  void pack();

  [[nodiscard]] MatchSet& matches() { return matches_; }
  [[nodiscard]] const MatchSet& matches() const { return matches_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] std::size_t shape_count() const { return kernels_.size(); }
  [[nodiscard]] const MatchTable& table(std::size_t shape) const { return matches_.table(shape); }
  [[nodiscard]] ShapeKernels& kernels(std::size_t shape) { return *kernels_[shape]; }
  [[nodiscard]] const ShapeKernels& kernels(std::size_t shape) const { return *kernels_[shape]; }
  /// Null where matches do not merge.
  [[nodiscard]] MergedTable* merged(std::size_t shape) { return merged_[shape].get(); }
  [[nodiscard]] const MergedTable* merged(std::size_t shape) const { return merged_[shape].get(); }
  [[nodiscard]] const compile::Shape& shape(std::size_t number) const {
    return matches_.shape(number);
  }
  [[nodiscard]] const compile::InteractionBody& body() const { return context_.body(number_); }
  [[nodiscard]] std::uint32_t match_count() const { return matches_.match_count(); }
  [[nodiscard]] Place place(DartId key) const { return matches_.place(key); }
  template <typename Visit>
  void in_order(const Visit& visit) const {
    matches_.in_order(visit);
  }

 private:
  void merge();
  void add_kernels();

  const ForceContext& context_;
  std::uint32_t number_;
  bool merge_;
  MatchSet matches_;
  std::vector<std::unique_ptr<ShapeKernels>> kernels_;  // by shape
  std::vector<std::unique_ptr<MergedTable>> merged_;
};

}  // namespace gmsim::engine
