// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "gmap/embedding_store.h"
#include "types/expr.h"

namespace gmsim::compile {

using types::EmbeddingId;
using types::ExprPtr;
using types::Slot;

/// How the value of an embedding or of a parameter reaches a program.
struct ValueSource {
  enum class Kind : std::uint8_t {
    Gathered,    ///< gathered for each match: a stored column, or one that the engine keeps
    Constant,    ///< the same everywhere: folded into the program
    Expression,  ///< computed inside the program from what `expr` reads
    Missing      ///< nobody has this value: reading it is an error
  };
  Kind kind = Kind::Gathered;
  std::vector<double> constant = {};
  ExprPtr expr = nullptr;
  /// Of an Expression: the frame it lives in.
  enum class Frame : std::uint8_t {
    SmallestDart,  ///< its own, `dart` bound to the smallest dart of the read orbit (derived values)
    ReadDart,      ///< its own, `dart` bound to the dart that is read at (a scene's expression)
    Item           ///< that of the item which reads it (a default that reads the item's names)
  };
  Frame frame = Frame::SmallestDart;
  Slot dart{};
  std::uint32_t frame_size = 0;

  static ValueSource gathered() { return {}; }
  static ValueSource uniform(std::vector<double> value);
  static ValueSource expression(ExprPtr expr, Frame frame, Slot dart, std::uint32_t frame_size);
  static ValueSource missing();
};

/// The sources of everything an item can read.
struct ValueSources {
  std::vector<ValueSource> embeddings;  ///< by EmbeddingId
  /// Parameters that are no embeddings (of criteria), by slot.
  std::vector<std::pair<Slot, ValueSource>> parameters;

  [[nodiscard]] const ValueSource& operator[](EmbeddingId id) const {
    return embeddings[types::index(id)];
  }
  [[nodiscard]] const ValueSource* find_parameter(Slot slot) const;
};

/// Columns where the store has one, defaults as constants where it has none, derived values as
/// expressions.
[[nodiscard]] ValueSources stored_sources(const gmap::EmbeddingSchema& schema,
                                          const gmap::EmbeddingStore& store);

/// By EmbeddingId: the values that change while the integrator runs: `moving` themselves (position,
/// velocity) and derived values that read one of them, the clock or a force, directly or through
/// other derived values. The other derived values change only when a rule changes the map or a
/// value, so they can be kept as columns.
[[nodiscard]] std::vector<bool> values_in_motion(const gmap::EmbeddingSchema& schema,
                                                 const std::vector<EmbeddingId>& moving);

}  // namespace gmsim::compile
