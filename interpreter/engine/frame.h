// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "engine/stack_memory.h"
#include "types/expr.h"
#include "types/value.h"

namespace gmsim::engine {

using Arena = StackMemory<double>;

/// The locals of one item: a dart, numbers or a collection of darts in each slot.
class Frame {
 public:
  explicit Frame(std::uint32_t slots = 0) : cells_(slots) {}
  Frame(Frame&&) = default;
  Frame& operator=(Frame&&) = default;
  /// Empties all slots and makes room for `slots` of them.
  void reset(std::uint32_t slots);

  void set(types::Slot slot, types::DartId dart);
  void set(types::Slot slot, std::span<const double> numbers);
  void set(types::Slot slot, std::vector<types::DartId> darts);
  void set(types::Slot slot, const types::Value& value);
  [[nodiscard]] bool has(types::Slot slot) const { return cell(slot).kind != Kind::Empty; }

  [[nodiscard]] types::DartId dart(types::Slot slot) const { return cell(slot).dart; }
  [[nodiscard]] std::span<const double> numbers(types::Slot slot) const {
    return {cell(slot).numbers, cell(slot).count};
  }
  [[nodiscard]] const std::vector<types::DartId>& darts(types::Slot slot) const {
    return *cell(slot).darts;
  }

 private:
  friend class TreeWalker;
  enum class Kind : std::uint8_t { Empty, Dart, Numbers, Darts };
  struct Cell {
    Kind kind = Kind::Empty;
    std::uint32_t count = 0;
    types::DartId dart = types::kNoDart;
    double* numbers = nullptr;
    std::vector<types::DartId>* darts = nullptr;
  };
  [[nodiscard]] const Cell& cell(types::Slot slot) const { return cells_[types::index(slot)]; }
  [[nodiscard]] Cell& cell(types::Slot slot) { return cells_[types::index(slot)]; }

  /// The cell of a slot that is given a value until the next reset.
  [[nodiscard]] Cell& use(types::Slot slot) {
    Cell& target = cell(slot);
    if (target.kind == Kind::Empty) used_.push_back(slot);
    return target;
  }

  std::vector<Cell> cells_;
  std::vector<types::Slot> used_;  // with a value
  std::deque<std::vector<types::DartId>> collections_;
  Arena arena_;
};

/// Parameters that a caller gives to a rule or an operation.
using Arguments = std::vector<std::pair<types::Slot, types::Value>>;

}  // namespace gmsim::engine
