// SPDX-License-Identifier: MIT
#include "cli/number_checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace gmsim::cli {
namespace {

template <typename Number>
bool is_number(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end;
}

/// `good(text)` decides; `wanted` completes "this takes …" and is shown by `-h`.
template <typename Good>
void take(CLI::Option* option, const std::string& wanted, const Good& good) {
  option->check(CLI::Validator(
      [wanted, good](const std::string& text) {
        return good(text) ? std::string() : fmt::format("`{}` is not {}", text, wanted);
      },
      ""));
}

}  // namespace

void take_whole_numbers(CLI::Option* option, std::int64_t least, std::int64_t most) {
  take(option, fmt::format("a whole number from {} to {}", least, most),
       [least, most](const std::string& text) {
         std::int64_t number = 0;
         return is_number(text, number) && number >= least && number <= most;
       });
}

void take_counts(CLI::Option* option) {
  take(option, "a whole number from 1", [](const std::string& text) {
    std::int32_t number = 0;
    return is_number(text, number) && number >= 1;
  });
}

void take_positive_numbers(CLI::Option* option) {
  take(option, "a number above 0", [](const std::string& text) {
    double number = 0;
    return is_number(text, number) && std::isfinite(number) && number > 0;
  });
}

void take_numbers_from_zero(CLI::Option* option) {
  take(option, "a number from 0", [](const std::string& text) {
    double number = 0;
    return is_number(text, number) && std::isfinite(number) && number >= 0;
  });
}

}  // namespace gmsim::cli
