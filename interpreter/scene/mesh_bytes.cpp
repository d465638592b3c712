// SPDX-License-Identifier: MIT
#include "scene/mesh_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace gmsim::scene {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

template <class Number>
std::optional<Number> parse_whole(std::string_view word) {
  word = without_plus(word);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parse_real(std::string_view word) {
  const auto value = parse_whole<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  return parse_whole<std::int64_t>(word);
}

std::string shown(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return word.size() > kLongest ? text + "..." : text;
}

void MeshBytes::set_binary(bool binary, int size_bytes) {
  binary_ = binary;
  size_bytes_ = size_bytes;
}

void MeshBytes::skip_space() {
  while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
}

std::string_view MeshBytes::word(std::string_view what) {
  skip_space();
  word_at_ = at_;
  while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
  if (at_ == word_at_) fail(fmt::format("the file ends where {} is expected", what));
  return bytes_.substr(word_at_, at_ - word_at_);
}

std::string_view MeshBytes::rest_of_line() {
  const std::size_t begin = at_;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  at_ = std::min(end + 1, bytes_.size());
  std::string_view line = bytes_.substr(begin, end - begin);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view MeshBytes::quoted(std::string_view what) {
  skip_space();
  if (at_end() || bytes_[at_] != '"') fail(fmt::format("{} must stand between quotes", what));
  const std::size_t end = bytes_.find('"', at_ + 1);
  if (end == std::string_view::npos) fail(fmt::format("the quotes around {} never close", what));
  const std::string_view text = bytes_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return text;
}

std::int64_t MeshBytes::text_integer(std::string_view what) {
  const std::string_view text = word(what);
  const auto value = parse_integer(text);
  if (!value) fail_at(word_at_, fmt::format("`{}` where {} is expected", shown(text), what));
  return *value;
}

double MeshBytes::text_real(std::string_view what) {
  const std::string_view text = word(what);
  const auto value = parse_real(text);
  if (!value) {
    fail_at(word_at_,
            fmt::format("`{}` where {}, a finite number, is expected", shown(text), what));
  }
  return *value;
}

template <class Number>
Number MeshBytes::raw(std::string_view what) {
  if (remaining() < sizeof(Number)) fail(fmt::format("the file ends where {} is expected", what));
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), bytes_.data() + at_, sizeof(Number));
  if (swap_) std::reverse(bytes.begin(), bytes.end());
  at_ += sizeof(Number);
  return std::bit_cast<Number>(bytes);
}

std::int32_t MeshBytes::integer(std::string_view what) {
  if (binary_) return raw<std::int32_t>(what);
  const std::int64_t value = text_integer(what);
  if (value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::int32_t>::max()) {
    fail_at(word_at_, fmt::format("{} is too large for {}", value, what));
  }
  return static_cast<std::int32_t>(value);
}

std::uint64_t MeshBytes::size(std::string_view what) {
  if (binary_) return size_bytes_ == 8 ? raw<std::uint64_t>(what) : raw<std::uint32_t>(what);
  const std::int64_t value = text_integer(what);
  if (value < 0) fail_at(word_at_, fmt::format("{} is negative: {}", what, value));
  return static_cast<std::uint64_t>(value);
}

double MeshBytes::real(std::string_view what) {
  if (!binary_) return text_real(what);
  const std::size_t begin = at_;
  const auto value = raw<double>(what);
  if (!std::isfinite(value)) fail_at(begin, fmt::format("{} is not a finite number", what));
  return value;
}

void MeshBytes::expect_room(std::uint64_t count, ItemSize item, std::string_view what) const {
  // In text every number takes a digit and a separator at least.
  const std::uint64_t bytes = binary_ ? item.integers * 4 +
                                            item.sizes * static_cast<std::uint64_t>(size_bytes_) +
                                            item.reals * 8
                                      : (item.integers + item.sizes + item.reals) * 2;
  if (bytes > 0 && count > remaining() / bytes + 1) {
    fail(fmt::format("{} {} announced, but only {} bytes are left in the file", count, what,
                     remaining()));
  }
}

void MeshBytes::fail_at(std::size_t offset, std::string message) const {
  MeshFileError error{std::move(message), std::nullopt, std::nullopt};
  if (binary_) {
    error.byte = offset;
  } else {
    error.line =
        1 + static_cast<std::size_t>(std::count(
                bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
  }
  throw error;
}

}  // namespace gmsim::scene
