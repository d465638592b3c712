// SPDX-License-Identifier: MIT
#include "io/view_block.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/base64.h"
#include "support/check.h"

namespace gmsim::io {

std::uint32_t Quantiser::operator()(double value) const {
  if (!std::isfinite(value)) return steps + 1;
  if (!(high > low)) return 0;
  // Halves, because the difference of two numbers may be too large for a number.
  const double position = std::clamp((value / 2 - low / 2) / (high / 2 - low / 2), 0.0, 1.0);
  return static_cast<std::uint32_t>(std::lround(position * steps));
}

void ValueRange::add(double value) {
  if (!std::isfinite(value)) {
    ++not_finite;
    return;
  }
  low = std::min(low.value_or(value), value);
  high = std::max(high.value_or(value), value);
}

Quantiser ValueRange::quantiser(std::uint32_t steps) const {
  return {low.value_or(0), high.value_or(0), steps};
}

std::size_t ViewBlock::add_numbers(std::span<const std::uint32_t> numbers) {
  const std::size_t begin = bytes_.size();
  std::uint32_t before = 0;
  for (const std::uint32_t number : numbers) {
    const std::uint32_t difference = number - std::exchange(before, number);
    for (unsigned byte = 0; byte < 4; ++byte)
      bytes_.push_back(static_cast<std::uint8_t>(difference >> (8 * byte)));
  }
  return begin;
}

std::size_t ViewBlock::add_steps(std::span<const std::uint16_t> steps) {
  const std::size_t begin = bytes_.size(), count = steps.size();
  bytes_.resize(begin + 2 * count);
  std::uint16_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int difference = steps[i] - std::exchange(before, steps[i]);
    bytes_[begin + i] = static_cast<std::uint8_t>(difference);
    bytes_[begin + count + i] = static_cast<std::uint8_t>(difference >> 8);
  }
  return begin;
}

std::size_t ViewBlock::add_values(std::span<const std::uint8_t> values) {
  const std::size_t begin = bytes_.size();
  bytes_.insert(bytes_.end(), values.begin(), values.end());
  return begin;
}

std::string ViewBlock::deflated_base64() const {
  uLongf size = compressBound(bytes_.size());
  std::vector<std::byte> packed(size);
  const int result = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_.data(),
                               bytes_.size(), Z_DEFAULT_COMPRESSION);
  GMSIM_CHECK(result == Z_OK, "zlib cannot deflate a block into the space it asked for");
  std::string text;
  append_base64(std::span(packed).first(size), text);
  return text;
}

}  // namespace gmsim::io
