// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace gmsim::support {

/// Our own mistake, not the user's: ends the program with exit code 70.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void internal_error(const char* file, int line, const std::string& what);

}  // namespace gmsim::support

/// States what the code relies on; kept in release builds.
#define GMSIM_CHECK(condition, what) \
  ((condition) ? void() : ::gmsim::support::internal_error(__FILE__, __LINE__, what))
