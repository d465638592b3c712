// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gmap/embedding_schema.h"
#include "gmap/orbit_index.h"

namespace gmsim::engine {

/// Which matches of an interaction depend on the links around a vertex. Matches that are gone may
/// still be named, so whoever asks has to look again; none is ever left out.
class VertexWatch {
 public:
  void clear();
  void add(gmap::Row vertex, gmap::DartId key);
  /// To be called when the first matches have all been added: packs the lists.
  void pack();
  /// visit(key), each at least once.
  template <typename Visit>
  void for_each(gmap::Row vertex, const Visit& visit) const {
    if (vertex + std::size_t{1} < begin_.size())
      for (std::uint32_t k = begin_[vertex]; k < begin_[vertex + 1]; ++k) visit(keys_[k]);
    if (const auto more = more_.find(vertex); more != more_.end())
      for (const gmap::DartId key : more->second) visit(key);
  }

 private:
  bool packed_ = false;
  std::vector<std::pair<gmap::Row, gmap::DartId>> unpacked_;
  std::vector<std::uint32_t> begin_;  // by vertex, into keys_
  std::vector<gmap::DartId> keys_;
  std::unordered_map<gmap::Row, std::vector<gmap::DartId>> more_;  // added after packing
};

/// Is a derived value, at any orbit, decided by the links within this orbit and by stored values on
/// its sub-orbits? Then it changes only when the orbit holds a changed dart.
[[nodiscard]] bool stays_in_orbit(const gmap::EmbeddingSchema& schema, types::EmbeddingId derived);

}  // namespace gmsim::engine
