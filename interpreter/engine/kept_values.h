// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/orbit_type.h"

namespace gmsim::engine {

/// Values of numbered functions at darts (compile/shared_values.h), kept while map and values stay
/// as they are. Emptying it costs nothing, however much it has held.
class KeptValues {
 public:
  KeptValues() { cells_.resize(kFirstSize); }

  void clear();
  /// Null when it is not kept. Valid until the next add().
  [[nodiscard]] const double* find(std::uint32_t function, types::DartId dart) const;
  /// Stores a value; set() says for which darts.
  [[nodiscard]] std::uint32_t add(std::span<const double> value);
  void set(std::uint32_t function, types::DartId dart, std::uint32_t value);

 private:
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t epoch = 0;  // another one than now: empty
    std::uint32_t value = 0;  // begin of a slice of `numbers_`
  };
  static constexpr std::size_t kFirstSize = 256;  // a power of two

  static std::uint64_t key(std::uint32_t function, types::DartId dart) {
    return std::uint64_t{function} << 32 | types::index(dart);
  }
  /// Where a key is, or the empty cell where it belongs (open addressing, Fibonacci hashing).
  [[nodiscard]] std::size_t place(std::uint64_t key) const;
  void grow();

  std::vector<Cell> cells_;
  std::vector<double> numbers_;
  std::size_t used_ = 0;
  std::uint32_t epoch_ = 1;
};

}  // namespace gmsim::engine
