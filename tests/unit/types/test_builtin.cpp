// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>

#include "types/builtin.h"

using namespace gmsim::types;

TEST_CASE("every builtin has one name, overloads that differ and a description") {
  std::set<std::string_view> names;
  for (const BuiltinInfo& row : builtins()) {
    INFO(row.name);
    CHECK(names.insert(row.name).second);
    CHECK(builtin(row.name) == row.id);
    CHECK(info(row.id).name == row.name);
    CHECK(row.doc.ends_with('.'));
    REQUIRE_FALSE(row.signatures.empty());
    for (std::size_t i = 0; i < row.signatures.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        CHECK(row.signatures[i].parameters != row.signatures[j].parameters);
  }
  CHECK_FALSE(builtin("nrom").has_value());
}

TEST_CASE("signatures hold the types that the table spells") {
  const auto& norm = info(Builtin::Norm).signatures;
  REQUIRE(norm.size() == 3);
  CHECK(norm[1].parameters == std::vector<ValueType>{{ValueKind::Vec2}});
  CHECK(norm[1].result == ValueType{ValueKind::Real});
  CHECK(info(Builtin::Identity3).signatures[0].parameters.empty());
  CHECK(info(Builtin::Clamp).signatures[0].parameters.size() == 3);
  CHECK(info(Builtin::MaxEigenpair).signatures[0].result == ValueType{ValueKind::EigenPair});
  CHECK(info(Builtin::Dot).units == UnitRule::Product);
}

TEST_CASE("results can be stored or are eigenpairs, parameters can be stored") {
  for (const BuiltinInfo& row : builtins())
    for (const Signature& signature : row.signatures) {
      INFO(row.name);
      CHECK((is_storable(signature.result) || signature.result.kind == ValueKind::EigenPair));
      for (const ValueType& parameter : signature.parameters) CHECK(is_storable(parameter));
    }
}
