// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/kernel/record_sums.h"
#include "support/check.h"

namespace gmsim::engine {

/// A list for each row, all in one array. A list that outgrows its place moves to the end; what it
/// leaves behind is lost until rebuild(), but never more than a few times what it needs.
template <typename Entry>
class RowLists {
 public:
  /// Makes lists anew: room for `count(row)` entries in each, none of which is there yet.
  template <typename Count>
  void rebuild(std::size_t rows, const Count& count) {
    lists_.assign(rows, {});
    std::uint32_t begin = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      lists_[row] = {begin, 0, count(row), 0};
      begin += lists_[row].capacity;
    }
    entries_.assign(begin, Entry{});
  }
  /// Makes room for further rows with empty lists.
  void grow(std::size_t rows) {
    if (rows > lists_.size()) lists_.resize(rows);
  }
  [[nodiscard]] std::size_t rows() const { return lists_.size(); }
  [[nodiscard]] std::span<const Entry> operator[](std::size_t row) const {
    return {entries_.data() + lists_[row].begin, lists_[row].count};
  }

  /// To change entries where they are.
  [[nodiscard]] std::span<Entry> entries(std::size_t row) {
    return {entries_.data() + lists_[row].begin, lists_[row].count};
  }

  void append(std::size_t row, const Entry& entry) { insert(row, lists_[row].count, entry); }
  void insert(std::size_t row, std::size_t at, const Entry& entry) {
    SlotList& list = lists_[row];
    if (list.count == list.capacity) move_to_end(list);
    Entry* const begin = entries_.data() + list.begin;
    std::copy_backward(begin + at, begin + list.count, begin + list.count + 1);
    begin[at] = entry;
    ++list.count;
  }
  void erase(std::size_t row, std::size_t at) {
    SlotList& list = lists_[row];
    GMSIM_CHECK(at < list.count, "an entry that is taken away was not there");
    Entry* const begin = entries_.data() + list.begin;
    std::copy(begin + at + 1, begin + list.count, begin + at);
    --list.count;
  }
  void clear(std::size_t row) { lists_[row].count = 0; }

  // As sum_records() wants them.
  [[nodiscard]] const SlotList* lists() const { return lists_.data(); }
  [[nodiscard]] const Entry* entries() const { return entries_.data(); }

 private:
  void move_to_end(SlotList& list) {
    const auto begin = static_cast<std::uint32_t>(entries_.size());
    list.capacity = list.count + list.count / 2 + 4;
    entries_.resize(begin + list.capacity);
    std::copy_n(entries_.begin() + list.begin, list.count, entries_.begin() + begin);
    list.begin = begin;
  }

  std::vector<SlotList> lists_;
  std::vector<Entry> entries_;
};

}  // namespace gmsim::engine
