// SPDX-License-Identifier: MIT
#include "engine/force_sums.h"

#include <algorithm>

#include "support/check.h"

namespace gmsim::engine {

void ForceSums::make_room() {
  std::uint32_t begin = 0;
  for (SlotList& list : lists_) {
    list.begin = begin;
    begin += list.capacity;
  }
  slots_.resize(begin);
  orders_.resize(begin);
}

void ForceSums::grow(Row vertices) {
  if (vertices > lists_.size()) lists_.resize(vertices);
}

/// Moves a full list to the end; its old place is lost until all lists are made again.
void ForceSums::extend(SlotList& list) {
  const auto begin = static_cast<std::uint32_t>(slots_.size());
  list.capacity = list.count + list.count / 2 + 4;
  slots_.resize(begin + list.capacity);
  orders_.resize(begin + list.capacity);
  std::copy_n(slots_.begin() + list.begin, list.count, slots_.begin() + begin);
  std::copy_n(orders_.begin() + list.begin, list.count, orders_.begin() + begin);
  list.begin = begin;
}

void ForceSums::insert(const Term& term) {
  SlotList& list = lists_[term.vertex];
  if (list.count == list.capacity) extend(list);
  std::uint32_t at = list.begin + list.count++;
  for (; at > list.begin && term.order < orders_[at - 1]; --at) {
    orders_[at] = orders_[at - 1];
    slots_[at] = slots_[at - 1];
  }
  orders_[at] = term.order;
  slots_[at] = term.slot;
  if (internal(term.order)) ++list.inner;
}

std::size_t ForceSums::find(Row vertex, ForceOrder order) const {
  const SlotList& list = lists_[vertex];
  const auto begin = orders_.begin() + list.begin, end = begin + list.count;
  const auto at = std::lower_bound(begin, end, order);
  GMSIM_CHECK(at != end && *at == order, "a force that is taken away was not there");
  return static_cast<std::size_t>(at - orders_.begin());
}

void ForceSums::erase(Row vertex, ForceOrder order) {
  SlotList& list = lists_[vertex];
  const std::size_t at = find(vertex, order);
  const std::size_t after = list.begin + list.count - at - 1;
  std::copy_n(slots_.begin() + at + 1, after, slots_.begin() + at);
  std::copy_n(orders_.begin() + at + 1, after, orders_.begin() + at);
  --list.count;
  if (internal(order)) --list.inner;
}

void ForceSums::move(Row from, Row to, ForceOrder order) {
  const SignedSlot slot = slots_[find(from, order)];
  erase(from, order);
  insert({to, order, slot});
}

namespace {

double* numbers(VertexRecord* records, Row row) {
  return records == nullptr ? nullptr : &records[row].x;
}

}  // namespace

void ForceSums::sum(const VertexRecord* forces, Row begin, Row end, const Totals& out) const {
  if (begin >= end) return;
  sum_records(&forces->x, lists_.data() + begin, slots_.data(), end - begin,
              numbers(out.all, begin), numbers(out.internal, begin));
}

void ForceSums::sum(const VertexRecord* forces, Row vertex, std::span<const SignedSlot> slots,
                    const Totals& out) const {
  SlotList list = lists_[vertex];
  list.begin = 0;
  sum_records(&forces->x, &list, slots.data(), 1, numbers(out.all, vertex),
              numbers(out.internal, vertex));
}

}  // namespace gmsim::engine
