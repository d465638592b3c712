// SPDX-License-Identifier: MIT
#include "engine/value_machine.h"

#include <algorithm>
#include <cmath>

#include "engine/builtins.h"
#include "engine/matrix_product.h"
#include "engine/tree_eval.h"
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

namespace {

/// One double from one or two.
template <typename Function>
void each(const double* a, std::uint32_t count, double* out, const Function& function) {
  for (std::uint32_t i = 0; i < count; ++i) out[i] = function(a[i]);
}
template <typename Function>
void each(const double* a, const double* b, std::uint32_t count, double* out,
          const Function& function) {
  for (std::uint32_t i = 0; i < count; ++i) out[i] = function(a[i], b[i]);
}

/// Of one component; most values have one or three.
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

/// out := function(number, component) for each component of each lane.
template <typename Function>
void each_scaled(const double* number, const double* value, std::uint32_t lanes,
                 std::uint32_t count, double* out, const Function& function) {
  if (count == 1) return each(number, value, lanes, out, function);
  for (std::uint32_t lane = 0; lane < lanes; ++lane, value += count, out += count) {
    for (std::uint32_t i = 0; i < count; ++i) out[i] = function(number[lane], value[i]);
  }
}

}  // namespace

bool ValueMachine::execute(const Instruction& by, Register& result) {
  const std::uint32_t lanes = lanes_[by.domain].count;
  const std::uint32_t total = lanes * by.count;
  const auto make_darts = [&] {
    DartId* out = dart_memory_.allocate(lanes);
    result.darts = out;
    return out;
  };
  const auto make_numbers = [&] {
    double* out = number_memory_.allocate(total);
    result.numbers = out;
    return out;
  };
  const auto a = [&] { return numbers(by.args[0]); };
  const auto b = [&] { return numbers(by.args[1]); };
  const auto c = [&] { return numbers(by.args[2]); };
  const auto each_lane = [&](const auto& function) {
    double* const out = make_numbers();
    for (std::uint32_t lane = 0; lane < lanes; ++lane) out[lane] = function(lane) ? 1.0 : 0.0;
  };
  switch (by.op) {
    case ValueOp::Node:
      node(by, make_darts());
      return true;
    case ValueOp::Alpha: {
      const DartId* const links = state_.map.alphas(by.number).data();
      const DartId* const from = darts(by.args[0]);
      DartId* const out = make_darts();
      for (std::uint32_t lane = 0; lane < lanes; ++lane) out[lane] = links[types::index(from[lane])];
      return true;
    }
    case ValueOp::Smallest:
      find_smallest(by, make_darts());
      return true;
    case ValueOp::ChooseDart: {
      DartId* const out = make_darts();
      for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        out[lane] = darts(by.args[a()[lane] != 0.0 ? 1 : 2])[lane];
      }
      return true;
    }
    case ValueOp::SpreadDart:
      spread(by, darts(by.args[0]), make_darts());
      return true;
    case ValueOp::Members:
    case ValueOp::Quotient:
    case ValueOp::Polygon:
    case ValueOp::AllOrbits:
    case ValueOp::Range:
      return open(by, result);
    case ValueOp::Spread:
      spread(by, a(), make_numbers());
      return true;
    case ValueOp::Constant:
      std::copy_n(program_->constants.data() + by.number, by.count, make_numbers());
      return true;
    case ValueOp::Parameter:
      return parameter(by, make_numbers());
    case ValueOp::Time:
      *make_numbers() = state_.time;
      return true;
    case ValueOp::Step:
      *make_numbers() = static_cast<double>(state_.step);
      return true;
    case ValueOp::Dt:
      *make_numbers() = state_.dt;
      return true;
    case ValueOp::Random: {
      double* const out = make_numbers();
      for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        const auto seed = static_cast<std::int64_t>(a()[lane]);
        out[lane] = random_number(seed, state_, by.orbit, darts(by.args[1])[lane]);
      }
      return true;
    }
    case ValueOp::Free:
      each_lane([&](auto lane) { return state_.map.is_free(by.number, darts(by.args[0])[lane]); });
      return true;
    case ValueOp::SameDart:
      each_lane([&](auto lane) { return darts(by.args[0])[lane] == darts(by.args[1])[lane]; });
      return true;
    case ValueOp::Read:
      return read(by, make_numbers());
    case ValueOp::Has: {
      const bool mark = state_.program.schema[by.embedding].role == gmap::EmbeddingRole::Presence;
      each_lane([&](auto lane) {
        const auto value = stored_.at(by.embedding, darts(by.args[0])[lane]);
        return !value.empty() && (!mark || value[0] != 0.0);
      });
      return true;
    }
    case ValueOp::Negate:
      each(a(), total, make_numbers(), std::negate<>());
      return true;
    case ValueOp::Add:
      each(a(), b(), total, make_numbers(), std::plus<>());
      return true;
    case ValueOp::Subtract:
      each(a(), b(), total, make_numbers(), std::minus<>());
      return true;
    case ValueOp::Multiply:
      each(a(), b(), total, make_numbers(), std::multiplies<>());
      return true;
    case ValueOp::Scale:
      each_scaled(a(), b(), lanes, by.count, make_numbers(), std::multiplies<>());
      return true;
    case ValueOp::Divide:
      each_scaled(b(), a(), lanes, by.count, make_numbers(), [](double d, double x) { return x / d; });
      return true;
    case ValueOp::DivideWhole:
      each(a(), b(), total, make_numbers(), [](double x, double y) { return std::trunc(x / y); });
      return true;
    case ValueOp::Power:
      each(a(), b(), total, make_numbers(), power);
      return true;
    case ValueOp::Less:
      each_lane([&](auto lane) { return a()[lane] < b()[lane]; });
      return true;
    case ValueOp::LessEqual:
      each_lane([&](auto lane) { return a()[lane] <= b()[lane]; });
      return true;
    case ValueOp::Equal: {
      const std::uint32_t size = count(by.args[0]);
      each_lane([&](auto lane) {
        const double* const left = a() + std::size_t{lane} * size;
        return std::equal(left, left + size, b() + std::size_t{lane} * size);
      });
      return true;
    }
    case ValueOp::And:
      each_lane([&](auto lane) { return a()[lane] != 0.0 && b()[lane] != 0.0; });
      return true;
    case ValueOp::Or:
      each_lane([&](auto lane) { return a()[lane] != 0.0 || b()[lane] != 0.0; });
      return true;
    case ValueOp::Not:
      each_lane([&](auto lane) { return a()[lane] == 0.0; });
      return true;
    case ValueOp::Choose: {
      double* out = make_numbers();
      for (std::uint32_t lane = 0; lane < lanes; ++lane, out += by.count) {
        const double* const value = a()[lane] != 0.0 ? b() : c();
        copy_components(value + std::size_t{lane} * by.count, by.count, out);
      }
      return true;
    }
    case ValueOp::Tuple: {
      double* const out = make_numbers();
      for (std::uint32_t i = 0; i < by.count; ++i) {
        const double* const component = numbers(by.args[i]);
        for (std::uint32_t lane = 0; lane < lanes; ++lane) out[lane * by.count + i] = component[lane];
      }
      return true;
    }
    case ValueOp::Part: {
      const std::uint32_t size = count(by.args[0]);
      double* out = make_numbers();
      for (std::uint32_t lane = 0; lane < lanes; ++lane, out += by.count) {
        copy_components(a() + std::size_t{lane} * size + by.number, by.count, out);
      }
      return true;
    }
    case ValueOp::Element:
      return element(by, make_numbers());
    case ValueOp::Call:
      call(by, make_numbers());
      return true;
    case ValueOp::Product: {
      double* const out = make_numbers();
      const std::uint32_t left = count(by.args[0]), right = count(by.args[1]);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        multiply(by.left, a() + lane * left, by.right, b() + lane * right, out + lane * by.count);
      }
      return true;
    }
    case ValueOp::Sum:
    case ValueOp::Mean:
    case ValueOp::Minimum:
    case ValueOp::Maximum:
    case ValueOp::Count:
    case ValueOp::CountTrue:
    case ValueOp::Any:
    case ValueOp::All:
    case ValueOp::Lowest:
    case ValueOp::Highest:
    case ValueOp::Pick:
    case ValueOp::PickDart:
      return fold(by, result);
  }
  return false;
}

// ---- darts --------------------------------------------------------------------------------------

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

// ---- numbers ------------------------------------------------------------------------------------

bool ValueMachine::read(const Instruction& by, double* out) const {
  const DartId* const at = darts(by.args[0]);
  const StoredValues::Source source = stored_[by.embedding];
  for (std::uint32_t lane = 0; lane < lanes_[by.domain].count; ++lane, out += by.count) {
    const std::span<const double> value = source.at(at[lane]);
    if (value.empty()) return false;
    copy_components(value.data(), by.count, out);
  }
  return true;
}

bool ValueMachine::parameter(const Instruction& by, double* out) const {
  const auto slot = static_cast<Slot>(by.number);
  if (!frame_->has(slot) || frame_->numbers(slot).size() != by.count) return false;
  std::copy_n(frame_->numbers(slot).begin(), by.count, out);
  return true;
}

bool ValueMachine::element(const Instruction& by, double* out) const {
  const std::uint32_t size = count(by.args[0]);
  for (std::size_t lane = 0; lane < lanes_[by.domain].count; ++lane, out += by.count) {
    const double position = numbers(by.args[1])[lane];
    if (!(position >= 0.0 && position < by.number)) return false;
    const std::size_t offset = static_cast<std::uint32_t>(position) * by.count;
    copy_components(numbers(by.args[0]) + lane * size + offset, by.count, out);
  }
  return true;
}

void ValueMachine::call(const Instruction& by, double* out) const {
  const BuiltinFunction function = builtin_function(by.builtin);
  BuiltinCall arguments;
  arguments.overload = by.number;
  std::uint32_t sizes[BuiltinCall::kMaxArguments] = {};
  for (std::size_t k = 0; k < by.args.size() && by.args[k] != LaneDomain::kNone; ++k) {
    arguments.arguments[k] = numbers(by.args[k]);
    sizes[k] = count(by.args[k]);
  }
  for (std::uint32_t lane = 0; lane < lanes_[by.domain].count; ++lane, out += by.count) {
    function(arguments, out);
    for (int k = 0; k < BuiltinCall::kMaxArguments; ++k) arguments.arguments[k] += sizes[k];
  }
}

}  // namespace gmsim::engine
