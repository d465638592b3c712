// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "compile/value_program.h"
#include "engine/frame.h"
#include "engine/matcher.h"
#include "engine/quotient_filter.h"
#include "engine/rewrite_rows.h"
#include "engine/stack_memory.h"
#include "engine/state.h"
#include "engine/stored_values.h"

namespace gmsim::engine {

/// Copies a value; most have one component or three.
template <typename T>
void copy_components(const T* from, std::uint32_t count, T* out) {
  if (count == 1) {
    *out = *from;
  } else if (count == 3) {
    for (int i = 0; i < 3; ++i) out[i] = from[i];
  } else {
    std::copy_n(from, count, out);
  }
}

/// Runs value programs: every operation in the order of the tree evaluator, so with its bits.
class ValueMachine {
 public:
  explicit ValueMachine(const State& state) : state_(state), stored_(state), filter_(state) {}

  /// Computes all values at a match; `frame` holds the parameters. False when something has no
  /// value, which need not be something that a tree would look at.
  bool run(const compile::ValueProgram& program, const Match& match, RowPlan& rows,
           const Frame& frame);
  /// Of the last run: the components of the first lane, then of the next.
  [[nodiscard]] std::span<const double> value(compile::ValueId id) const {
    const compile::ValueInstruction& by = program_->code[id];
    return {registers_[id].numbers, std::size_t{by.count} * lanes_[by.domain].count};
  }

 private:
  using Instruction = compile::ValueInstruction;

  union Register {
    const double* numbers;
    const DartId* darts;
    const std::uint32_t* lanes;  // of the members that a fold chose
  };
  /// The lanes of a domain.
  struct Lanes {
    std::uint32_t count = 0;
    const RowPlan::Groups* rows = nullptr;  // null: members
    std::vector<DartId> darts;              // of members
    std::vector<double> numbers;            // of a range
    std::vector<std::uint32_t> above;       // for each lane the one that it belongs to
    std::vector<std::uint32_t> ends;        // for each lane above the end of its members
    void clear() {
      darts.clear();
      numbers.clear();
      above.clear();
      ends.clear();
    }
    void close() { ends.push_back(static_cast<std::uint32_t>(above.size())); }
  };

  bool execute(const Instruction& by, Register& result);
  // value_machine.cpp
  void find_darts(const Instruction& by, DartId* out) const;
  void node(const Instruction& by, DartId* out) const;
  void find_smallest(const Instruction& by, DartId* out) const;
  template <typename T>
  void spread(const Instruction& by, const T* from, T* out) const;
  // value_machine_numbers.cpp
  bool compute(const Instruction& by, double* out) const;
  bool read(const Instruction& by, double* out) const;
  bool element(const Instruction& by, double* out) const;
  bool parameter(const Instruction& by, double* out) const;
  void call(const Instruction& by, double* out) const;
  // value_machine_folds.cpp
  bool open(const Instruction& by, Register& result);
  void list_members(const Instruction& by, Lanes& lanes);
  void list_quotient(const Instruction& by, Lanes& lanes);
  bool list_polygons(const Instruction& by, Lanes& lanes);
  void list_range(const Instruction& by, Lanes& lanes);
  void list_orbits(const Instruction& by, Lanes& lanes);
  bool fold(const Instruction& by, Register& result);
  bool fold_sum(const Instruction& by, double* out) const;
  bool fold_extreme(const Instruction& by, double* out, std::uint32_t* lanes) const;
  void fold_truth(const Instruction& by, double* out) const;

  [[nodiscard]] const double* numbers(compile::ValueId id) const { return registers_[id].numbers; }
  [[nodiscard]] const DartId* darts(compile::ValueId id) const { return registers_[id].darts; }
  [[nodiscard]] std::uint32_t count(compile::ValueId id) const { return program_->code[id].count; }

  const State& state_;
  StoredValues stored_;
  QuotientFilter filter_;
  // of one run
  const compile::ValueProgram* program_ = nullptr;
  const Match* match_ = nullptr;
  const Frame* frame_ = nullptr;
  std::vector<Register> registers_;  // by instruction
  std::vector<Lanes> lanes_;         // by domain
  StackMemory<double> number_memory_;
  StackMemory<std::uint32_t> lane_memory_;
  StackMemory<DartId> dart_memory_;
};

template <typename T>
void ValueMachine::spread(const Instruction& by, const T* from, T* out) const {
  const Lanes& lanes = lanes_[by.domain];
  if (lanes.rows == nullptr) {
    for (const std::uint32_t lane : lanes.above) {
      copy_components(from + std::size_t{lane} * by.count, by.count, out);
      out += by.count;
    }
    return;
  }
  const Lanes& above = lanes_[program_->code[by.args[0]].domain];
  for (const std::uint32_t row : lanes.rows->first) {
    copy_components(from + std::size_t{above.rows->of[row]} * by.count, by.count, out);
    out += by.count;
  }
}

}  // namespace gmsim::engine
