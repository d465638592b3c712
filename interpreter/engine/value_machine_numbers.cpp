// SPDX-License-Identifier: MIT
// ValueMachine: numbers of each lane from darts and numbers of the same lane.
#include <algorithm>
#include <cmath>

#include "engine/builtins.h"
#include "engine/matrix_product.h"
#include "engine/tree_eval.h"
#include "engine/value_machine.h"

namespace gmsim::engine {

using compile::LaneDomain;
using compile::ValueOp;

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

bool ValueMachine::compute(const Instruction& by, double* out) const {
  const std::uint32_t lanes = lanes_[by.domain].count;
  const std::uint32_t total = lanes * by.count;
  const auto a = [&] { return numbers(by.args[0]); };
  const auto b = [&] { return numbers(by.args[1]); };
  const auto c = [&] { return numbers(by.args[2]); };
  const auto each_lane = [&](const auto& function) {
    for (std::uint32_t lane = 0; lane < lanes; ++lane) out[lane] = function(lane) ? 1.0 : 0.0;
  };
  switch (by.op) {
    case ValueOp::Spread:
      spread(by, a(), out);
      return true;
    case ValueOp::Constant:
      std::copy_n(program_->constants.data() + by.number, by.count, out);
      return true;
    case ValueOp::Parameter:
      return parameter(by, out);
    case ValueOp::Time:
      *out = state_.time;
      return true;
    case ValueOp::Step:
      *out = static_cast<double>(state_.step);
      return true;
    case ValueOp::Dt:
      *out = state_.dt;
      return true;
    case ValueOp::Random: {
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
      return read(by, out);
    case ValueOp::Has: {
      const bool mark = state_.program.schema[by.embedding].role == gmap::EmbeddingRole::Presence;
      each_lane([&](auto lane) {
        const auto value = stored_.at(by.embedding, darts(by.args[0])[lane]);
        return !value.empty() && (!mark || value[0] != 0.0);
      });
      return true;
    }
    case ValueOp::Negate:
      each(a(), total, out, std::negate<>());
      return true;
    case ValueOp::Add:
      each(a(), b(), total, out, std::plus<>());
      return true;
    case ValueOp::Subtract:
      each(a(), b(), total, out, std::minus<>());
      return true;
    case ValueOp::Multiply:
      each(a(), b(), total, out, std::multiplies<>());
      return true;
    case ValueOp::Scale:
      each_scaled(a(), b(), lanes, by.count, out, std::multiplies<>());
      return true;
    case ValueOp::Divide:
      each_scaled(b(), a(), lanes, by.count, out, [](double d, double x) { return x / d; });
      return true;
    case ValueOp::DivideWhole:
      each(a(), b(), total, out, [](double x, double y) { return std::trunc(x / y); });
      return true;
    case ValueOp::Power:
      each(a(), b(), total, out, power);
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
      for (std::uint32_t lane = 0; lane < lanes; ++lane, out += by.count) {
        const double* const value = a()[lane] != 0.0 ? b() : c();
        copy_components(value + std::size_t{lane} * by.count, by.count, out);
      }
      return true;
    }
    case ValueOp::Tuple: {
      for (std::uint32_t i = 0; i < by.count; ++i) {
        const double* const component = numbers(by.args[i]);
        for (std::uint32_t lane = 0; lane < lanes; ++lane)
          out[lane * by.count + i] = component[lane];
      }
      return true;
    }
    case ValueOp::Part: {
      const std::uint32_t size = count(by.args[0]);
      for (std::uint32_t lane = 0; lane < lanes; ++lane, out += by.count) {
        copy_components(a() + std::size_t{lane} * size + by.number, by.count, out);
      }
      return true;
    }
    case ValueOp::Element:
      return element(by, out);
    case ValueOp::Call:
      call(by, out);
      return true;
    case ValueOp::Product: {
      const std::uint32_t left = count(by.args[0]), right = count(by.args[1]);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        multiply(by.left, a() + lane * left, by.right, b() + lane * right, out + lane * by.count);
      }
      return true;
    }
    default:
      support::internal_error(__FILE__, __LINE__, "the instruction computes no number");
  }
}

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
