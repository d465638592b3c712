// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/span.h"
#include "types/expr.h"
#include "types/orbit_type.h"
#include "types/unit.h"
#include "types/value.h"

namespace gmsim::gmap {

/// What happens to a value when its orbit changes (theory 2.4, language 1).
enum class EmbeddingKind {
  Intensive,  ///< copied to every part of a split
  Extensive,  ///< divided over all parts of a split, summed on a merge
  Derived     ///< computed from other values, never stored by a rule
};

/// Which value stays when a rule joins orbits and gives no value.
enum class MergePolicy { None, Equal, First, Mean, Min, Max };

/// What a named value is: an `embedding`, or part of an interaction: the mark that an orbit carries
/// it ("stretch_spring", bool, optional), a parameter ("stretch_spring.rest", optional) or a
/// result.
enum class EmbeddingRole { Data, Presence, Parameter, Result };

struct EmbeddingDecl {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  types::OrbitType orbit;
  EmbeddingKind kind = EmbeddingKind::Intensive;
  EmbeddingRole role = EmbeddingRole::Data;
  MergePolicy merge = MergePolicy::None;
  bool optional = false;                      ///< an orbit may lack the value
  std::optional<types::Value> default_value;  ///< given to created orbits
  types::ExprPtr weight;                      ///< Extensive: `split EXPR`, else null (equal parts)
  types::ExprPtr derivation;                  ///< Derived: the expression
  types::Slot dart_slot{};                    ///< the dart that weight and derivation speak of
  std::uint32_t frame_size = 1;               ///< slots that weight and derivation need
  std::string doc;
  support::Span span;
  double unit_scale = 1.0;  ///< SI units per declared unit ([mm]: 1e-3); values are held in SI
};

/// The named values of one dimension of the map; EmbeddingId is the position.
class EmbeddingSchema {
 public:
  types::EmbeddingId add(EmbeddingDecl declaration);
  [[nodiscard]] const EmbeddingDecl& operator[](types::EmbeddingId id) const {
    return declarations_[types::index(id)];
  }
  [[nodiscard]] EmbeddingDecl& operator[](types::EmbeddingId id) {
    return declarations_[types::index(id)];
  }
  /// By name; of several with one name the newest, which shadows the others.
  [[nodiscard]] std::optional<types::EmbeddingId> find(std::string_view name) const;
  [[nodiscard]] std::size_t size() const { return declarations_.size(); }
  [[nodiscard]] auto begin() const { return declarations_.begin(); }
  [[nodiscard]] auto end() const { return declarations_.end(); }

 private:
  std::vector<EmbeddingDecl> declarations_;
};

}  // namespace gmsim::gmap
