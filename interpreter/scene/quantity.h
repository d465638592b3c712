// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"
#include "types/unit.h"

namespace gmsim::scene {

/// A number of a scene, in SI.
struct Quantity {
  double value = 0;
  types::MaybeUnit unit;  ///< empty: a bare number
  double scale = 1;       ///< SI units per unit written
};

/// Reads `60` or `60 N/m` from a scalar; reports what is neither, or not finite. A unit must agree
/// with `wanted` where that is known.
[[nodiscard]] std::optional<Quantity> read_quantity(const YamlNode& node,
                                                    const types::MaybeUnit& wanted,
                                                    support::SourceMap& sources,
                                                    support::Diagnostics& diagnostics);

/// A unit as the schema writes it, "m/s^2"; "" is the dimensionless one.
[[nodiscard]] types::Unit schema_unit(std::string_view text);

}  // namespace gmsim::scene
