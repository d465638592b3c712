// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/force_field.h"
#include "engine/kernel/record_sums.h"
#include "engine/match_table.h"

namespace gmsim::engine {

/// Where the kernels of one table leave their forces: root k of match m in slot
/// first + k * capacity + m of one array for all tables.
struct ForceBlock {
  const MatchTable* table = nullptr;
  std::vector<std::uint32_t> roles;  ///< vertex of each root
  std::uint32_t interaction = 0;     ///< number in the model
  std::uint32_t first = 0;
  std::uint32_t capacity = 0;        ///< matches there is room for

  [[nodiscard]] std::uint32_t slot(std::uint32_t root, std::uint32_t match) const {
    return first + root * capacity + match;
  }
  [[nodiscard]] std::uint32_t end() const {
    return slot(static_cast<std::uint32_t>(roles.size()), 0);
  }
};

/// For each vertex the slots of the forces on it, in the canonical order: by interaction, by key of
/// the match, by root. Sums follow this order, so they do not depend on rows, blocks or threads.
class ForceSums {
 public:
  /// `blocks` in the order of their interactions; those of one interaction have different keys.
  void rebuild(std::span<const ForceBlock> blocks, Row vertices);
  /// Makes room for new vertices, without forces.
  void grow(Row vertices);
  // Local changes. `before(a, b)` of two slots: does a come first in the canonical order?
  template <typename Before>
  void insert(Row vertex, std::uint32_t slot, const Before& before) {
    const std::span<std::uint32_t> list = with_room(vertex);
    std::size_t at = list.size() - 1;
    for (; at > 0 && before(slot, list[at - 1]); --at) list[at] = list[at - 1];
    list[at] = slot;
  }
  void erase(Row vertex, std::uint32_t slot);
  /// The same force is in another slot now.
  void rename(Row vertex, std::uint32_t from, std::uint32_t to);

  /// out[v] := sum of the forces on vertex v, for begin <= v < end.
  void sum(const VertexRecord* forces, Row begin, Row end, VertexRecord* out) const;
  [[nodiscard]] std::span<const std::uint32_t> slots(Row vertex) const {
    const List& list = lists_[vertex];
    return {slots_.data() + list.begin, list.count};
  }
  [[nodiscard]] Row vertices() const { return static_cast<Row>(lists_.size()); }

 private:
  using List = SlotList;
  void append(std::span<const ForceBlock> of_one_interaction);
  /// The list of a vertex with one entry more, which is the last.
  std::span<std::uint32_t> with_room(Row vertex);

  std::vector<List> lists_;  // by vertex row
  std::vector<std::uint32_t> slots_;
};

}  // namespace gmsim::engine
