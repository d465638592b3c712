// SPDX-License-Identifier: MIT
#include "engine/value_machine.h"

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using compile::LaneDomain;
using compile::ValueOp;

bool ValueMachine::run(const compile::ValueProgram& program, const Match& match, RowPlan& rows,
                       const Frame& frame) {
  program_ = &program;
  match_ = &match;
  frame_ = &frame;
  stored_.update();
  number_memory_.release({});
  lane_memory_.release({});
  dart_memory_.release({});
  if (registers_.size() < program.code.size()) registers_.resize(program.code.size());
  if (lanes_.size() < program.domains.size()) lanes_.resize(program.domains.size());
  for (std::size_t k = 0; k < program.domains.size(); ++k) {
    const LaneDomain& domain = program.domains[k];
    lanes_[k].rows = nullptr;
    if (domain.above != LaneDomain::kNone) continue;
    lanes_[k].rows = &rows.groups(domain.chosen, domain.joined);
    lanes_[k].count = static_cast<std::uint32_t>(lanes_[k].rows->first.size());
  }
  for (std::size_t k = 0; k < program.code.size(); ++k) {
    if (!execute(program.code[k], registers_[k])) return false;
  }
  return true;
}

/// Instructions of one kind stand together in value_ops.def.
bool ValueMachine::execute(const Instruction& by, Register& result) {
  const std::uint32_t lanes = lanes_[by.domain].count;
  if (by.op <= ValueOp::SpreadDart) {
    DartId* const out = dart_memory_.allocate(lanes);
    result.darts = out;
    find_darts(by, out);
    return true;
  }
  if (by.op <= ValueOp::Range) return open(by, result);
  if (by.op > ValueOp::Product) return fold(by, result);
  double* const out = number_memory_.allocate(std::size_t{lanes} * by.count);
  result.numbers = out;
  return compute(by, out);
}

// ---- darts --------------------------------------------------------------------------------------

void ValueMachine::find_darts(const Instruction& by, DartId* out) const {
  const std::uint32_t lanes = lanes_[by.domain].count;
  switch (by.op) {
    case ValueOp::Node:
      return node(by, out);
    case ValueOp::Alpha: {
      const DartId* const links = state_.map.alphas(by.number).data();
      const DartId* const from = darts(by.args[0]);
      for (std::uint32_t lane = 0; lane < lanes; ++lane)
        out[lane] = links[types::index(from[lane])];
      return;
    }
    case ValueOp::Smallest:
      return find_smallest(by, out);
    case ValueOp::ChooseDart:
      for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        out[lane] = darts(by.args[numbers(by.args[0])[lane] != 0.0 ? 1 : 2])[lane];
      }
      return;
    default:
      spread(by, darts(by.args[0]), out);
  }
}

void ValueMachine::node(const Instruction& by, DartId* out) const {
  const auto column = static_cast<compile::Column>(by.number);
  for (const std::uint32_t row : lanes_[by.domain].rows->first) *out++ = match_->dart(row, column);
}

void ValueMachine::find_smallest(const Instruction& by, DartId* out) const {
  const gmap::OrbitIndex* index = state_.store.find_index(by.orbit);
  const DartId* const from = darts(by.args[0]);
  for (std::uint32_t lane = 0; lane < lanes_[by.domain].count; ++lane) {
    out[lane] = index != nullptr ? index->smallest(index->row(from[lane]))
                                 : gmap::smallest_dart(state_.map, by.orbit, from[lane]);
  }
}

}  // namespace gmsim::engine
