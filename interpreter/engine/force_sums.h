// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/force_field.h"
#include "engine/kernel/record_sums.h"

namespace gmsim::engine {

/// The place of a force among the others on its vertex: by interaction, by key of the match, by
/// number among the forces of the match.
using ForceOrder = std::uint64_t;
[[nodiscard]] inline ForceOrder force_order(std::uint32_t interaction, DartId key,
                                            std::uint32_t force) {
  return std::uint64_t{interaction} << 48 | std::uint64_t{types::index(key)} << 16 | force;
}
[[nodiscard]] inline std::uint32_t interaction_of(ForceOrder order) {
  return static_cast<std::uint32_t>(order >> 48);
}
[[nodiscard]] inline std::uint32_t force_of(ForceOrder order) {
  return static_cast<std::uint32_t>(order & 0xffffu);
}
[[nodiscard]] inline DartId key_of(ForceOrder order) {
  return DartId{static_cast<std::uint32_t>(order >> 16)};
}

/// For each vertex the slots of the forces on it, in the canonical order. Sums follow this order, so
/// they do not depend on rows, blocks or threads.
class ForceSums {
 public:
  struct Term {
    Row vertex = 0;
    ForceOrder order = 0;
    SignedSlot slot{};
  };

  /// `each(visit)` calls visit(term) for all terms, those of one vertex in the canonical order; it is
  /// called twice.
  template <typename EachTerm>
  void rebuild(Row vertices, const EachTerm& each) {
    lists_.assign(vertices, {});
    each([&](const Term& term) { ++lists_[term.vertex].capacity; });
    make_room();
    each([&](const Term& term) {
      SlotList& list = lists_[term.vertex];
      slots_[list.begin + list.count] = term.slot;
      orders_[list.begin + list.count++] = term.order;
    });
  }
  /// Makes room for new vertices, without forces.
  void grow(Row vertices);
  void insert(const Term& term);
  void erase(Row vertex, ForceOrder order);

  /// out[v] := sum of the forces on vertex v, for begin <= v < end.
  void sum(const VertexRecord* forces, Row begin, Row end, VertexRecord* out) const;
  [[nodiscard]] std::span<const ForceOrder> orders(Row vertex) const {
    const SlotList& list = lists_[vertex];
    return {orders_.data() + list.begin, list.count};
  }
  [[nodiscard]] Row vertices() const { return static_cast<Row>(lists_.size()); }

 private:
  void make_room();
  void extend(SlotList& list);

  std::vector<SlotList> lists_;  // by vertex row
  std::vector<SignedSlot> slots_;
  std::vector<ForceOrder> orders_;  // parallel to slots_
};

}  // namespace gmsim::engine
