// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/state.h"

namespace gmsim::engine {

/// Quick access to the values of all embeddings of a state.
class StoredValues {
 public:
  explicit StoredValues(const State& state) : state_(state) {}

  /// Looks for new columns; call before reading.
  void update() {
    if (!sources_.empty() && listed_ == state_.store.column_count()) return;
    sources_.assign(state_.program.schema.size(), Source{});
    for (const EmbeddingId id : state_.store.embeddings()) {
      sources_[types::index(id)] = {&state_.store.column(id), &state_.store.index_of(id)};
    }
    listed_ = state_.store.column_count();
  }
  struct Source {
    const gmap::EmbeddingColumn* column = nullptr;  // null: not in use
    const gmap::OrbitIndex* index = nullptr;

    /// The stored value at a dart; empty when it has none.
    [[nodiscard]] std::span<const double> at(DartId dart) const {
      if (column == nullptr) return {};
      const Row row = index->row(dart);
      return column->has(row) ? column->get(row) : std::span<const double>{};
    }
  };
  [[nodiscard]] const Source& operator[](EmbeddingId id) const {
    return sources_[types::index(id)];
  }
  [[nodiscard]] bool in_use(EmbeddingId id) const {
    return sources_[types::index(id)].column != nullptr;
  }
  [[nodiscard]] std::span<const double> at(EmbeddingId id, DartId dart) const {
    return (*this)[id].at(dart);
  }

 private:
  const State& state_;
  std::vector<Source> sources_;  // by EmbeddingId
  std::size_t listed_ = 0;
};

}  // namespace gmsim::engine
