// SPDX-License-Identifier: MIT
// ValueMachine: the members of collections, and what is made of them.
#include <algorithm>
#include <cmath>

#include "engine/value_machine.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using compile::ValueOp;

// ---- members ------------------------------------------------------------------------------------

bool ValueMachine::open(const Instruction& by, Register& result) {
  Lanes& lanes = lanes_[by.domain];
  lanes.clear();
  switch (by.op) {
    case ValueOp::Members:
      list_members(by, lanes);
      break;
    case ValueOp::Quotient:
      list_quotient(by, lanes);
      break;
    case ValueOp::Polygon:
      if (!list_polygons(by, lanes)) return false;
      break;
    case ValueOp::AllOrbits:
      list_orbits(by, lanes);
      break;
    default:
      list_range(by, lanes);
  }
  lanes.count = static_cast<std::uint32_t>(lanes.above.size());
  if (by.op == ValueOp::Range) {
    result.numbers = lanes.numbers.data();
  } else {
    result.darts = lanes.darts.data();
  }
  return true;
}

namespace {

/// Most orbits are small, and often nearly in order.
void sort_darts(DartId* begin, DartId* end) {
  constexpr std::ptrdiff_t kFew = 32;
  if (end - begin > kFew) return std::sort(begin, end);
  for (DartId* next = begin + 1; next < end; ++next) {
    const DartId dart = *next;
    DartId* place = next;
    for (; place > begin && place[-1] > dart; --place) *place = place[-1];
    *place = dart;
  }
}

}  // namespace

void ValueMachine::list_members(const Instruction& by, Lanes& lanes) {
  const std::uint32_t above = lanes_[program_->domains[by.domain].above].count;
  for (std::uint32_t lane = 0; lane < above; ++lane) {
    const std::size_t begin = lanes.darts.size();
    gmap::for_each_dart(state_.map, by.orbit, darts(by.args[0])[lane],
                        [&](DartId d) { lanes.darts.push_back(d); });
    sort_darts(lanes.darts.data() + begin, lanes.darts.data() + lanes.darts.size());
    lanes.above.resize(lanes.darts.size(), lane);
    lanes.close();
  }
}

void ValueMachine::list_quotient(const Instruction& by, Lanes& lanes) {
  const Lanes& all = lanes_[program_->code[by.args[0]].domain];
  std::uint32_t member = 0, lane = 0;
  for (const std::uint32_t end : all.ends) {
    filter_.start(by.orbit, by.inner);
    for (; member < end; ++member) {
      if (!filter_.keeps(all.darts[member])) continue;
      lanes.darts.push_back(all.darts[member]);
      lanes.above.push_back(lane);
    }
    lanes.close();
    ++lane;
  }
}

bool ValueMachine::list_polygons(const Instruction& by, Lanes& lanes) {
  const std::uint32_t above = lanes_[program_->domains[by.domain].above].count;
  for (std::uint32_t lane = 0; lane < above; ++lane) {
    const auto corners = gmap::polygon(state_.map, darts(by.args[0])[lane]);
    if (!corners) return false;
    lanes.darts.insert(lanes.darts.end(), corners->begin(), corners->end());
    lanes.above.resize(lanes.darts.size(), lane);
    lanes.close();
  }
  return true;
}

void ValueMachine::list_orbits(const Instruction& by, Lanes& lanes) {
  const std::uint32_t above = lanes_[program_->domains[by.domain].above].count;
  const std::vector<DartId> orbits = gmap::all_orbits(state_.map, by.orbit);
  for (std::uint32_t lane = 0; lane < above; ++lane) {
    lanes.darts.insert(lanes.darts.end(), orbits.begin(), orbits.end());
    lanes.above.resize(lanes.darts.size(), lane);
    lanes.close();
  }
}

void ValueMachine::list_range(const Instruction& by, Lanes& lanes) {
  const std::uint32_t above = lanes_[program_->domains[by.domain].above].count;
  for (std::uint32_t lane = 0; lane < above; ++lane) {
    const double end = numbers(by.args[1])[lane];
    for (double x = numbers(by.args[0])[lane]; x < end; x += 1.0) lanes.numbers.push_back(x);
    lanes.above.resize(lanes.numbers.size(), lane);
    lanes.close();
  }
}

// ---- folds --------------------------------------------------------------------------------------

bool ValueMachine::fold(const Instruction& by, Register& result) {
  const std::uint32_t lanes = lanes_[by.domain].count;
  if (by.op == ValueOp::Lowest || by.op == ValueOp::Highest) {
    std::uint32_t* const chosen = lane_memory_.allocate(lanes);
    result.lanes = chosen;
    return fold_extreme(by, number_memory_.allocate(lanes), chosen);
  }
  if (by.op == ValueOp::PickDart) {
    DartId* const out = dart_memory_.allocate(lanes);
    result.darts = out;
    const std::uint32_t* const chosen = registers_[by.args[0]].lanes;
    for (std::uint32_t k = 0; k < lanes; ++k) out[k] = darts(by.args[1])[chosen[k]];
    return true;
  }
  double* const out = number_memory_.allocate(std::size_t{lanes} * by.count);
  result.numbers = out;
  switch (by.op) {
    case ValueOp::Sum:
    case ValueOp::Mean:
      return fold_sum(by, out);
    case ValueOp::Minimum:
    case ValueOp::Maximum:
      return fold_extreme(by, out, nullptr);
    case ValueOp::Pick: {
      const std::uint32_t* const chosen = registers_[by.args[0]].lanes;
      for (std::size_t k = 0; k < lanes; ++k) {
        std::copy_n(numbers(by.args[1]) + std::size_t{chosen[k]} * by.count, by.count,
                    out + k * by.count);
      }
      return true;
    }
    default:
      fold_truth(by, out);
      return true;
  }
}

bool ValueMachine::fold_sum(const Instruction& by, double* out) const {
  const double* term = numbers(by.args[0]);
  std::uint32_t member = 0;
  for (const std::uint32_t end : lanes_[static_cast<std::size_t>(by.number)].ends) {
    const std::uint32_t terms = end - member;
    std::fill_n(out, by.count, 0.0);
    for (; member < end; ++member, term += by.count) {
      for (std::uint32_t i = 0; i < by.count; ++i) out[i] += term[i];
    }
    if (by.op == ValueOp::Mean) {
      if (terms == 0) return false;
      for (std::uint32_t i = 0; i < by.count; ++i) out[i] /= static_cast<double>(terms);
    }
    out += by.count;
  }
  return true;
}

/// The least or largest term and, where `lanes` is given, the first member that has it.
bool ValueMachine::fold_extreme(const Instruction& by, double* out, std::uint32_t* lanes) const {
  const double* const term = numbers(by.args[0]);
  const bool least = by.op == ValueOp::Minimum || by.op == ValueOp::Lowest;
  std::uint32_t member = 0;
  for (const std::uint32_t end : lanes_[static_cast<std::size_t>(by.number)].ends) {
    if (member == end) return false;
    std::uint32_t best = member;
    for (; member < end; ++member) {
      if (std::isnan(term[member])) return false;
      if (least ? term[member] < term[best] : term[member] > term[best]) best = member;
    }
    *out++ = term[best];
    if (lanes != nullptr) *lanes++ = best;
  }
  return true;
}

void ValueMachine::fold_truth(const Instruction& by, double* out) const {
  std::uint32_t member = 0;
  for (const std::uint32_t end : lanes_[static_cast<std::size_t>(by.number)].ends) {
    const std::uint32_t all = end - member;
    std::uint32_t holds = all;
    if (by.op != ValueOp::Count) {
      const double* const truth = numbers(by.args[0]);
      holds = static_cast<std::uint32_t>(
          std::count_if(truth + member, truth + end, [](double x) { return x != 0.0; }));
    }
    member = end;
    switch (by.op) {
      case ValueOp::Any:
        *out++ = holds > 0 ? 1.0 : 0.0;
        break;
      case ValueOp::All:
        *out++ = holds == all ? 1.0 : 0.0;
        break;
      default:
        *out++ = holds;
    }
  }
}

}  // namespace gmsim::engine
