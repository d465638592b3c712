// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/force_kernel.h"
#include "engine/force_matches.h"
#include "engine/force_merge.h"
#include "engine/match_table.h"
#include "engine/match_watch.h"

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

/// The matches of one interaction at work: a table for each shape, and where matches merge the
/// merged form of it.
class InteractionTables {
 public:
  struct Place {
    std::uint32_t shape = kNowhere;
    std::uint32_t row = 0;
  };
  static constexpr std::uint32_t kNowhere = 0xffffffffu;

  InteractionTables(const ForceContext& context, std::uint32_t number, bool merge);

  /// Finds all matches anew.
  std::optional<support::Diagnostic> rebuild();

  // Repairing single matches. After a change of the map, look again at those that watch it.

  /// False: only rebuild() is safe.
  [[nodiscard]] bool repairable() const { return watch_.complete() && own_stay_; }
  [[nodiscard]] const MatchWatch& watch() const { return watch_; }
  /// Finds and adds the match of an orbit that has none in the tables; empty when there is none.
  std::optional<support::Diagnostic> find_at(DartId dart, std::optional<DartId>& key);
  /// The dart from which a match was found.
  [[nodiscard]] DartId hook(Place place) const;
  /// Takes a match out.
  void remove(DartId key);
  /// Brings the matches of all tables into the order of their keys, without vacant rows, and merges
  /// them again.
  void pack();

  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] std::size_t shape_count() const { return tables_.size(); }
  [[nodiscard]] const MatchTable& table(std::size_t shape) const { return *tables_[shape]; }
  [[nodiscard]] ShapeKernels& kernels(std::size_t shape) { return *kernels_[shape]; }
  [[nodiscard]] const ShapeKernels& kernels(std::size_t shape) const { return *kernels_[shape]; }
  /// Null where matches do not merge.
  [[nodiscard]] MergedTable* merged(std::size_t shape) { return merged_[shape].get(); }
  [[nodiscard]] const MergedTable* merged(std::size_t shape) const { return merged_[shape].get(); }
  [[nodiscard]] const compile::Shape& shape(std::size_t number) const {
    return finder_.shapes()[number];
  }
  [[nodiscard]] const compile::InteractionBody& body() const { return context_.body(number_); }
  [[nodiscard]] std::uint32_t match_count() const;
  /// Where the match of the orbit with this smallest dart is.
  [[nodiscard]] Place place(DartId key) const {
    return types::index(key) < places_.size() ? places_[types::index(key)] : Place{};
  }
  /// visit(shape, row) for all matches, ascending by key.
  template <typename Visit>
  void in_order(const Visit& visit) const {
    for (const Place& place : places_)
      if (place.shape != kNowhere) visit(place.shape, place.row);
  }

 private:
  void add(const ForceMatch& match);
  void merge();
  void add_shape();

  const ForceContext& context_;
  std::uint32_t number_;
  bool merge_;
  ForceMatches finder_;
  std::vector<std::unique_ptr<MatchTable>> tables_;      // by shape
  std::vector<std::unique_ptr<ShapeKernels>> kernels_;
  std::vector<std::unique_ptr<MergedTable>> merged_;
  std::vector<Place> places_;                            // by key
  MatchWatch watch_;
  bool own_stay_ = true;  // what matches know themselves changes with the darts they depend on alone
};

}  // namespace gmsim::engine
