// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gmsim::io {

/// Maps numbers between `low` and `high` to `steps` + 1 whole numbers from 0 on; the middle of the
/// number's step is off by at most (high - low) / steps / 2. What is not finite becomes steps + 1.
struct Quantiser {
  double low = 0, high = 0;
  std::uint32_t steps = 1;

  [[nodiscard]] std::uint32_t operator()(double value) const;
};
inline constexpr std::uint32_t kPositionSteps = 65534;  ///< 16 bits
inline constexpr std::uint32_t kValueSteps = 254;       ///< 8 bits

/// The least range that holds all finite numbers that were added; nothing before the first.
struct ValueRange {
  std::optional<double> low, high;
  std::size_t not_finite = 0;

  void add(double value);
  [[nodiscard]] Quantiser quantiser(std::uint32_t steps) const;
};

/// Tables one after another, in forms that can be deflated well: neighbours in a mesh have numbers
/// and positions that differ little. Each function returns the byte its table begins at.
class ViewBlock {
 public:
  /// Four bytes a number, little-endian: the difference to the number before, modulo 2^32.
  std::size_t add_numbers(std::span<const std::uint32_t> numbers);
  /// Differences modulo 2^16 likewise: the low bytes of all, then the high bytes.
  std::size_t add_steps(std::span<const std::uint16_t> steps);
  /// As they are.
  std::size_t add_values(std::span<const std::uint8_t> values);
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }
  /// zlib's format (RFC 1950), as base64.
  [[nodiscard]] std::string deflated_base64() const;

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace gmsim::io
