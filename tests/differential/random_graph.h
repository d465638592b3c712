// SPDX-License-Identifier: MIT
// Random arithmetic graphs, built twice in step: with and without simplification.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "compile/ir.h"

namespace gmsim::tests {

namespace ir = compile::ir;

/// One value in both graphs.
struct TwinNode {
  ir::NodeId plain = ir::kNone;
  ir::NodeId simple = ir::kNone;
};

class RandomGraph {
 public:
  static constexpr std::uint32_t kInputs = 4;  // of each kind, Real and Vec3

  /// `barriers`: with operations that are constant for derivatives.
  RandomGraph(std::uint32_t seed, bool barriers) : random_(seed), barriers_(barriers) {
    for (std::uint32_t k = 0; k < kInputs; ++k) {
      add_input(ir::ValueKind::Real, k);
      add_input(ir::ValueKind::Vec3, kInputs + k);
    }
    for (const double c : {0.0, 1.0, -1.0, 2.0, 0.5, -2.0, 3.0, -0.25, 0.1})
      keep({plain.constant(c), simple.constant(c)});
    for (const auto kind : {ir::ValueKind::Vec3, ir::ValueKind::Mat3, ir::ValueKind::Sym3})
      keep({plain.zero(kind), simple.zero(kind)});
    keep({plain.mask(true), simple.mask(true)});
    keep(axis(choose(3)));
    keep(make(ir::Op::Columns, pick(ir::ValueKind::Vec3), input(ir::ValueKind::Vec3),
              input(ir::ValueKind::Vec3)));
    keep(make(ir::Op::Diagonal, input(ir::ValueKind::Vec3)));
  }

  void grow(int operations) {
    while (operations-- > 0) keep(random_operation());
  }
  /// A number that depends on the last values of all kinds.
  TwinNode summary() {
    TwinNode sum = pools_[ir::ValueKind::Real].back();
    const TwinNode v = make(ir::Op::Dot, pools_[ir::ValueKind::Vec3].back(), input(ir::ValueKind::Vec3));
    const TwinNode m = make(ir::Op::Contract, pools_[ir::ValueKind::Mat3].back(), some_matrix());
    const TwinNode s = make(ir::Op::Trace, pools_[ir::ValueKind::Sym3].back());
    for (const TwinNode& part : {v, m, s}) sum = make(ir::Op::Add, sum, part);
    return sum;
  }
  TwinNode random_operation();
  TwinNode pick(ir::ValueKind kind) {
    const auto& pool = pools_[kind];
    // Mostly recent values, so that graphs get deep.
    const std::size_t recent = std::min<std::size_t>(pool.size(), 6);
    return choose(3) == 0 ? pool[choose(pool.size())] : pool[pool.size() - 1 - choose(recent)];
  }
  [[nodiscard]] const std::vector<ir::NodeId>& inputs() const { return inputs_; }
  [[nodiscard]] const std::map<ir::ValueKind, std::vector<TwinNode>>& pools() const { return pools_; }
  std::size_t choose(std::size_t count) { return random_() % count; }

  ir::Graph plain, simple;

 private:
  void add_input(ir::ValueKind kind, std::uint32_t role) {
    const ir::Input in{.role = role};
    keep({plain.input(in, kind), simple.input(in, kind)});
    inputs_.push_back(simple.input(in, kind));
  }
  TwinNode input(ir::ValueKind kind) { return pools_[kind][choose(kInputs)]; }
  void keep(TwinNode twin) { pools_[plain[twin.plain].type].push_back(twin); }
  TwinNode make(ir::Op op, TwinNode a, TwinNode b = {}, TwinNode c = {}, std::uint32_t aux = 0) {
    return {plain.make_plain(op, a.plain, b.plain, c.plain, aux),
            simple.make(op, a.simple, b.simple, c.simple, aux)};
  }
  TwinNode constant(double c) { return {plain.constant(c), simple.constant(c)}; }
  TwinNode axis(std::size_t k) {
    return make(ir::Op::Vector, constant(k == 0), constant(k == 1), constant(k == 2));
  }
  /// Within [0.5, 1.5].
  TwinNode positive() {
    const TwinNode bounded = make(ir::Op::Tanh, pick(ir::ValueKind::Real));
    const TwinNode half = make(ir::Op::Mul, constant(0.5), bounded);
    return make(ir::Op::Add, constant(1), half);
  }
  /// Within [-0.9, 0.9].
  TwinNode bounded() {
    return make(ir::Op::Mul, constant(0.9), make(ir::Op::Tanh, pick(ir::ValueKind::Real)));
  }
  /// Far from singular.
  TwinNode some_matrix() {
    const auto column = [&](std::size_t k) {
      const TwinNode small = make(ir::Op::Scale, constant(0.2), input(ir::ValueKind::Vec3));
      return make(ir::Op::Add, axis(k), small);
    };
    return make(ir::Op::Columns, column(0), column(1), column(2));
  }
  TwinNode some_sym() {
    const TwinNode spread = make(ir::Op::Vector, constant(3), constant(1), constant(-2));
    return make(ir::Op::Add, make(ir::Op::Diagonal, spread), make(ir::Op::Sym, some_matrix()));
  }
  TwinNode number_operation();
  TwinNode vector_operation();
  TwinNode matrix_operation();
  TwinNode sym_operation();
  TwinNode mask_operation();

  std::mt19937 random_;
  bool barriers_;
  std::map<ir::ValueKind, std::vector<TwinNode>> pools_;
  std::vector<ir::NodeId> inputs_;
};

inline TwinNode RandomGraph::random_operation() {
  switch (choose(8)) {
    case 0: case 1: case 2: return number_operation();
    case 3: case 4: return vector_operation();
    case 5: return matrix_operation();
    case 6: return sym_operation();
    default: return mask_operation();
  }
}

inline TwinNode RandomGraph::number_operation() {
  using ir::Op;
  using Kind = ir::ValueKind;
  const auto real = [&] { return pick(Kind::Real); };
  const auto vec = [&] { return pick(Kind::Vec3); };
  switch (choose(38)) {
    case 0: case 1: return make(Op::Add, real(), real());
    case 2: case 3: return make(Op::Sub, real(), real());
    case 4: return make(Op::Neg, real());
    case 5: case 6: case 7: return make(Op::Mul, real(), real());
    case 8: return make(Op::Div, real(), positive());
    case 9: return make(Op::Div, real(), constant(choose(2) == 0 ? -4 : 2));
    case 10: {
      const double exponents[] = {2, 3, -1, 5, 0.5, 1.7, -0.5, 0, 1};
      return make(Op::Pow, positive(), constant(exponents[choose(9)]));
    }
    case 11: return make(Op::Sqrt, positive());
    case 12: return make(Op::Abs, real());
    case 13: return make(Op::Sign, real());
    case 14: return make(Op::Min, real(), real());
    case 15: return make(Op::Max, real(), real());
    case 16: return make(choose(2) == 0 ? Op::Floor : Op::Ceil, real());
    case 17: return make(Op::Mod, real(), positive());
    case 18: return make(Op::Exp, bounded());
    case 19: return make(Op::Log, positive());
    case 20: return make(Op::Sin, real());
    case 21: return make(Op::Cos, real());
    case 22: return make(Op::Tan, bounded());
    case 23: return make(Op::Asin, bounded());
    case 24: return make(Op::Acos, bounded());
    case 25: return make(Op::Atan, real());
    case 26: return make(Op::Atan2, real(), real());
    case 27: return make(Op::Tanh, real());
    case 28: return make(Op::Component, vec(), {}, {}, static_cast<std::uint32_t>(choose(3)));
    case 29: {
      const bool sym = choose(2) == 0;
      return make(Op::Component, pick(sym ? Kind::Sym3 : Kind::Mat3), {}, {},
                  static_cast<std::uint32_t>(choose(sym ? 6 : 9)));
    }
    case 30: return make(Op::Dot, vec(), vec());
    case 31: return make(Op::Norm, vec());
    case 32: return make(Op::Trace, pick(choose(2) == 0 ? Kind::Sym3 : Kind::Mat3));
    case 33: return choose(2) == 0 ? make(Op::Det, some_matrix()) : make(Op::Det, some_sym());
    case 34: {
      const Kind kind = choose(2) == 0 ? Kind::Sym3 : Kind::Mat3;
      return make(Op::Contract, pick(kind), pick(kind));
    }
    case 35:
      return make(choose(2) == 0 ? Op::MaxEigenvalue : Op::MinEigenvalue, some_sym());
    case 36: return make(Op::AsReal, pick(Kind::Bool));
    default: return make(Op::Select, pick(Kind::Bool), real(), real());
  }
}

inline TwinNode RandomGraph::vector_operation() {
  using ir::Op;
  using Kind = ir::ValueKind;
  const auto real = [&] { return pick(Kind::Real); };
  const auto vec = [&] { return pick(Kind::Vec3); };
  switch (choose(barriers_ ? 14 : 12)) {
    case 0: return make(Op::Add, vec(), vec());
    case 1: return make(Op::Sub, vec(), vec());
    case 2: return make(Op::Neg, vec());
    case 3: return make(Op::Scale, real(), vec());
    case 4: return make(Op::Div, vec(), positive());
    case 5: return make(Op::Vector, real(), real(), real());
    case 6: return make(Op::Cross, vec(), vec());
    case 7: return make(Op::Normalize, vec());
    case 8: return make(Op::MatVec, pick(Kind::Mat3), vec());
    case 9: return make(Op::MatVec, pick(Kind::Sym3), vec());
    case 10: return make(Op::Select, pick(Kind::Bool), vec(), vec());
    case 11: {
      const TwinNode v = vec();
      const auto entry = [&](std::uint32_t k) { return make(Op::Component, v, {}, {}, k); };
      return make(Op::Vector, entry(0), entry(1), entry(2));
    }
    case 12: return make(Op::Frozen, vec());
    default: return make(choose(2) == 0 ? Op::MaxEigenvector : Op::MinEigenvector, some_sym());
  }
}

inline TwinNode RandomGraph::matrix_operation() {
  using ir::Op;
  using Kind = ir::ValueKind;
  const auto vec = [&] { return pick(Kind::Vec3); };
  const auto mat = [&] { return pick(Kind::Mat3); };
  switch (choose(12)) {
    case 0: return make(Op::Add, mat(), mat());
    case 1: return make(Op::Sub, mat(), mat());
    case 2: return make(Op::Neg, mat());
    case 3: return make(Op::Scale, pick(Kind::Real), mat());
    case 4: return make(Op::Outer, vec(), vec());
    case 5: return make(Op::MatMul, mat(), mat());
    case 6: return make(Op::Transpose, mat());
    case 7: return make(Op::Inverse, some_matrix());
    case 8: return make(Op::Full, pick(Kind::Sym3));
    case 9: return make(Op::Columns, vec(), vec(), vec());
    case 10: return make(Op::Polar, some_matrix());
    default: return make(Op::Select, pick(Kind::Bool), mat(), mat());
  }
}

inline TwinNode RandomGraph::sym_operation() {
  using ir::Op;
  using Kind = ir::ValueKind;
  const auto sym = [&] { return pick(Kind::Sym3); };
  switch (choose(8)) {
    case 0: return make(Op::Add, sym(), sym());
    case 1: return make(Op::Sub, sym(), sym());
    case 2: return make(Op::Scale, pick(Kind::Real), sym());
    case 3: return make(Op::Sym, pick(Kind::Mat3));
    case 4: return make(Op::Diagonal, pick(Kind::Vec3));
    case 5: return make(Op::Inverse, some_sym());
    case 6: return make(Op::Neg, sym());
    default: return make(Op::Select, pick(Kind::Bool), sym(), sym());
  }
}

inline TwinNode RandomGraph::mask_operation() {
  using ir::Op;
  using Kind = ir::ValueKind;
  const auto real = [&] { return pick(Kind::Real); };
  const auto mask = [&] { return pick(Kind::Bool); };
  switch (choose(6)) {
    case 0: return make(Op::Less, real(), real());
    case 1: return make(Op::LessEqual, real(), real());
    case 2: return make(Op::Equal, real(), real());
    case 3: return make(Op::And, mask(), mask());
    case 4: return make(Op::Or, mask(), mask());
    default: return make(Op::Not, mask());
  }
}

}  // namespace gmsim::tests
