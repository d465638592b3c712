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
  /// Where sums go, by row of the vertex index: of all forces, and of those without loads unless that
  /// is null.
  struct Totals {
    VertexRecord* all = nullptr;
    VertexRecord* internal = nullptr;
  };
  struct Term {
    Row vertex = 0;
    ForceOrder order = 0;
    SignedSlot slot{};
  };

  /// Terms of this order and later ones are of loads.
  void loads_from(ForceOrder order) { loads_from_ = order; }
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
      if (internal(term.order)) ++list.inner;
    });
  }
  /// Makes room for new vertices, without forces.
  void grow(Row vertices);
  void insert(const Term& term);
  void erase(Row vertex, ForceOrder order);
  /// The force goes to another vertex.
  void move(Row from, Row to, ForceOrder order);

  /// out.all[v] := sum of the forces on vertex v, for begin <= v < end.
  void sum(const VertexRecord* forces, Row begin, Row end, const Totals& out) const;
  /// The same from other forces, in the order of the list, with slots of their own.
  void sum(const VertexRecord* forces, Row vertex, std::span<const SignedSlot> slots,
           const Totals& out) const;
  [[nodiscard]] std::span<const ForceOrder> orders(Row vertex) const {
    const SlotList& list = lists_[vertex];
    return {orders_.data() + list.begin, list.count};
  }
  [[nodiscard]] Row vertices() const { return static_cast<Row>(lists_.size()); }

 private:
  [[nodiscard]] bool internal(ForceOrder order) const { return order < loads_from_; }
  /// Where the force is among all orders.
  [[nodiscard]] std::size_t find(Row vertex, ForceOrder order) const;
  void make_room();
  void extend(SlotList& list);

  ForceOrder loads_from_ = ~ForceOrder{0};
  std::vector<SlotList> lists_;  // by vertex row
  std::vector<SignedSlot> slots_;
  std::vector<ForceOrder> orders_;  // parallel to slots_
};

}  // namespace gmsim::engine
