// SPDX-License-Identifier: MIT
#include "engine/force_sums.h"

#include <algorithm>

#include "support/check.h"

namespace gmsim::engine {

namespace {

/// A match of one of several tables.
struct Entry {
  DartId key;
  std::uint32_t block;
  std::uint32_t row;
};

/// All matches of an interaction in the order of their keys.
std::vector<Entry> in_order(std::span<const ForceBlock> blocks) {
  std::vector<Entry> entries;
  for (std::uint32_t b = 0; b < blocks.size(); ++b)
    for (std::uint32_t row = 0; row < blocks[b].table->size(); ++row)
      entries.push_back({blocks[b].table->key(row), b, row});
  const auto before = [](const Entry& a, const Entry& b) { return a.key < b.key; };
  if (!std::is_sorted(entries.begin(), entries.end(), before))
    std::sort(entries.begin(), entries.end(), before);
  return entries;
}

}  // namespace

void ForceSums::rebuild(std::span<const ForceBlock> blocks, Row vertices) {
  lists_.assign(vertices, {});
  for (const ForceBlock& block : blocks)
    for (const std::uint32_t role : block.roles)
      for (const Row vertex : block.table->rows(role)) ++lists_[vertex].capacity;
  std::uint32_t begin = 0;
  for (List& list : lists_) {
    list.begin = begin;
    begin += list.capacity;
  }
  slots_.resize(begin);
  for (std::size_t first = 0, last = 0; first < blocks.size(); first = last) {
    while (last < blocks.size() && blocks[last].interaction == blocks[first].interaction) ++last;
    append(blocks.subspan(first, last - first));
  }
}

void ForceSums::append(std::span<const ForceBlock> of_one_interaction) {
  for (const Entry& entry : in_order(of_one_interaction)) {
    const ForceBlock& block = of_one_interaction[entry.block];
    for (std::uint32_t root = 0; root < block.roles.size(); ++root) {
      List& list = lists_[block.table->rows(block.roles[root])[entry.row]];
      slots_[list.begin + list.count++] = block.slot(root, entry.row);
    }
  }
}

void ForceSums::grow(Row vertices) {
  if (vertices > lists_.size()) lists_.resize(vertices);
}

std::span<std::uint32_t> ForceSums::with_room(Row vertex) {
  List& list = lists_[vertex];
  if (list.count == list.capacity) {  // moves to the end; the old place is lost until a rebuild
    const auto begin = static_cast<std::uint32_t>(slots_.size());
    list.capacity = list.count + list.count / 2 + 4;
    slots_.resize(begin + list.capacity);
    std::copy_n(slots_.begin() + list.begin, list.count, slots_.begin() + begin);
    list.begin = begin;
  }
  return {slots_.data() + list.begin, ++list.count};
}

void ForceSums::erase(Row vertex, std::uint32_t slot) {
  List& list = lists_[vertex];
  const auto begin = slots_.begin() + list.begin, end = begin + list.count;
  const auto at = std::find(begin, end, slot);
  GMSIM_CHECK(at != end, "a force that is taken away was not there");
  std::copy(at + 1, end, at);
  --list.count;
}

void ForceSums::rename(Row vertex, std::uint32_t from, std::uint32_t to) {
  const List& list = lists_[vertex];
  const auto begin = slots_.begin() + list.begin, end = begin + list.count;
  const auto at = std::find(begin, end, from);
  GMSIM_CHECK(at != end, "a force that moves was not there");
  *at = to;
}

void ForceSums::sum(const VertexRecord* forces, Row begin, Row end, VertexRecord* out) const {
  if (begin == end) return;
  sum_records(&forces->x, lists_.data() + begin, slots_.data(), end - begin, &out[begin].x);
}

}  // namespace gmsim::engine
