// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gmap/embedding_schema.h"
#include "gmap/gmap.h"

namespace gmsim::engine {

/// Which matches of an item depend on which darts. Matches that are gone may still be named, so
/// whoever asks has to look again; none is ever left out.
class DartWatch {
 public:
  void clear();
  void add(gmap::DartId dart, gmap::DartId key);
  /// To be called when the first matches have all been added: packs the lists.
  void pack();
  /// visit(key), each at least once.
  template <typename Visit>
  void for_each(gmap::DartId dart, const Visit& visit) const {
    const std::size_t d = types::index(dart);
    if (d + 1 < begin_.size())
      for (std::uint32_t k = begin_[d]; k < begin_[d + 1]; ++k) visit(keys_[k]);
    if (const auto more = more_.find(dart); more != more_.end())
      for (const gmap::DartId key : more->second) visit(key);
  }

 private:
  bool packed_ = false;
  std::vector<std::pair<gmap::DartId, gmap::DartId>> unpacked_;
  std::vector<std::uint32_t> begin_;  // by dart, into keys_
  std::vector<gmap::DartId> keys_;
  std::unordered_map<gmap::DartId, std::vector<gmap::DartId>> more_;  // added after packing
};

/// Is a derived value, at any orbit, decided by the links within this orbit and by stored values on
/// its sub-orbits? Then it changes only when the orbit holds a changed dart.
[[nodiscard]] bool stays_in_orbit(const gmap::EmbeddingSchema& schema, types::EmbeddingId derived);

}  // namespace gmsim::engine
