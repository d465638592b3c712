// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "support/check.h"
#include "types/value_type.h"

using namespace gmsim::types;

TEST_CASE("every name a user can write is a storable type that prints as that name") {
  CHECK(value_type_names().size() == 8);
  for (const std::string& name : value_type_names()) {
    INFO(name);
    REQUIRE(value_kind(name).has_value());
    const ValueType type{*value_kind(name)};
    CHECK(to_string(type) == name);
    CHECK(is_storable(type));
  }
  CHECK_FALSE(value_kind("dart").has_value());
  CHECK_FALSE(value_kind("Vec3").has_value());
}

TEST_CASE("arrays print their lengths, lose the first with an element and multiply components") {
  const ValueType type{ValueKind::Vec3, {4, 8}};
  CHECK(to_string(type) == "vec3[4][8]");
  CHECK(to_string(type.element()) == "vec3[8]");
  CHECK(type.element().element() == ValueType{ValueKind::Vec3});
  CHECK(component_count(type) == 96);
  CHECK(component_count({ValueKind::Sym3}) == 6);
  CHECK_THROWS_AS((void)ValueType{ValueKind::Real}.element(), gmsim::support::InternalError);
}

TEST_CASE("darts and collections are not stored") {
  for (ValueKind kind :
       {ValueKind::Dart, ValueKind::Darts, ValueKind::Forces, ValueKind::Range,
        ValueKind::EigenPair, ValueKind::Orbit, ValueKind::Zero, ValueKind::Error}) {
    CHECK_FALSE(is_storable({kind}));
    CHECK_THROWS_AS((void)component_count({kind}), gmsim::support::InternalError);
  }
}
