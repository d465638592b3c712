// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace CLI {
class Option;
}

/// Internal: which numbers an option takes, and what is said about others.
namespace gmsim::cli {

/// A whole number from `least` to `most`; shown as a range by `-h`.
void take_whole_numbers(CLI::Option* option, std::int64_t least, std::int64_t most);
/// A whole number from 1.
void take_counts(CLI::Option* option);
/// A finite number above 0, or from 0.
void take_positive_numbers(CLI::Option* option);
void take_numbers_from_zero(CLI::Option* option);

}  // namespace gmsim::cli
