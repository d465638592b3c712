// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compile/dependence.h"
#include "engine/row_lists.h"
#include "gmap/embedding_schema.h"
#include "gmap/gmap.h"

namespace gmsim::engine {

/// Which matches of an item rest on which darts, and on what of them. Matches that are gone may still
/// be named, so whoever asks has to look again; none is ever left out.
class DartWatch {
 public:
  struct Entry {
    gmap::DartId key = gmap::kNoDart;
    compile::Aspects what = 0;
  };

  void clear();
  void add(gmap::DartId dart, const Entry& entry);
  /// To be called when the first matches have all been added: packs the lists.
  void pack();
  [[nodiscard]] std::span<const Entry> at(gmap::DartId dart) const {
    const std::size_t d = types::index(dart);
    return d < lists_.rows() ? lists_[d] : std::span<const Entry>{};
  }

 private:
  bool packed_ = false;
  std::vector<std::pair<gmap::DartId, Entry>> unpacked_;
  RowLists<Entry> lists_;  // by dart
};

/// Is a derived value, at any orbit, decided by the links within this orbit and by stored values on
/// its sub-orbits? Then it changes only when the orbit holds a changed dart.
[[nodiscard]] bool stays_in_orbit(const gmap::EmbeddingSchema& schema, types::EmbeddingId derived);

}  // namespace gmsim::engine
