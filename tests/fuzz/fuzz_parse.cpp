// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/parse_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gmsim::fuzz::check_parsing(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
