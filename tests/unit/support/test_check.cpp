// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "support/check.h"

using gmsim::support::InternalError;

TEST_CASE("a check that holds does not evaluate its explanation") {
  bool asked = false;
  const auto explanation = [&] {
    asked = true;
    return std::string("why");
  };
  GMSIM_CHECK(1 + 1 == 2, explanation());
  CHECK_FALSE(asked);
}

TEST_CASE("a check that fails names place and reason") {
  try {
    GMSIM_CHECK(1 + 1 == 3, "arithmetic is broken");
    FAIL("the check passed");
  } catch (const InternalError& error) {
    const std::string what = error.what();
    CHECK(what.starts_with("tests/unit/support/test_check.cpp:"));
    CHECK(what.ends_with(": arithmetic is broken"));
  }
}
