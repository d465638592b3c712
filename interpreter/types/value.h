// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "types/orbit_type.h"
#include "types/value_type.h"

namespace gmsim::types {

/// One value at run time, as literals, defaults and the tree evaluator hold it.
/// Storable kinds fill `data` (component_count doubles; Bool is 0 or 1); Dart fills `dart`;
/// Darts fills `darts`; Forces fills `data` with three doubles a force; Range fills data[0..1];
/// EigenPair fills data[0] = value, data[1..3] = vector.
struct Value {
  ValueType type;
  std::vector<double> data = {};
  DartId dart = kNoDart;
  std::vector<DartId> darts = {};

  static Value boolean(bool b);
  static Value integer(std::int64_t i);
  static Value real(double x);
  static Value vec3(double x, double y, double z);
  static Value of_dart(DartId d);
  /// The zero of a storable type.
  static Value zero(const ValueType& type);

  [[nodiscard]] bool as_bool() const { return data.at(0) != 0.0; }
  [[nodiscard]] double as_real() const { return data.at(0); }
  /// Every component is finite.
  [[nodiscard]] bool finite() const;
};

/// The fewest digits that read back as the same number: "0.1", "1e+20", "-0", "nan".
[[nodiscard]] std::string number_text(double x);
/// "(0, 1.5, -2)", "true", "3.25"; matrices by rows, arrays in [], darts by id.
[[nodiscard]] std::string to_string(const Value& value);

}  // namespace gmsim::types
