// SPDX-License-Identifier: MIT
// OrbitIndex::repair, in two passes. The first walks each orbit that holds a touched dart and
// collects the rows its darts had; those rows are then open to be claimed. The second goes through
// the orbits by ascending smallest dart and gives each a row. The arrays of the index themselves
// hold the marks: while a repair runs, a marked entry names the part that was there last.
#include <algorithm>
#include <bit>

#include "gmap/journal.h"
#include "gmap/orbit_index.h"
#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

constexpr std::uint32_t kMark = 0x80000000u;  // darts and rows are below it

constexpr bool is_mark(std::uint32_t value) { return value >= kMark && value != kNoRow; }

/// Sorts different numbers below `end`: by a bit set when they are dense. `bits` is work space,
/// all zero before and after.
void sort_numbers(std::vector<std::uint32_t>& numbers, std::uint32_t end,
                  std::vector<std::uint64_t>& bits) {
  if (std::is_sorted(numbers.begin(), numbers.end())) return;
  if (numbers.size() < end / 256) return std::sort(numbers.begin(), numbers.end());
  bits.resize((end + 63) / 64);
  for (std::uint32_t n : numbers) bits[n / 64] |= std::uint64_t{1} << (n % 64);
  auto out = numbers.begin();
  for (std::uint32_t word = 0; word < bits.size(); ++word) {
    for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1) {
      *out++ = word * 64 + static_cast<std::uint32_t>(std::countr_zero(rest));
    }
    bits[word] = 0;
  }
}

}  // namespace

void OrbitRepair::clear() {
  orbits.clear();
  sources.clear();
  removed.clear();
  created = split = merged = 0;
  visited_darts = 0;
}

void OrbitIndex::repair(const GMap& map, std::span<const DartId> touched, OrbitRepair& repair,
                        Journal* journal) {
  if (journal != nullptr) journal->begin(*this);
  rows_.resize(map.dart_end(), kNoRow);
  repair.parts_.clear();
  repair.darts_.clear();
  repair.open_.clear();
  for (DartId d : touched) {
    GMSIM_CHECK(index(d) < rows_.size(), "touched dart is not of this map");
    if (is_mark(rows_[index(d)])) continue;
    if (map.alive(d)) {
      walk_part(map, d, repair, journal);
    } else if (rows_[index(d)] != kNoRow) {
      drop_dart(d, repair, journal);
    }
  }
  repair.visited_darts += repair.darts_.size();
  sort_parts(repair);
  name_parts(repair);
  close_rows(repair);
}

void OrbitIndex::drop_dart(DartId d, OrbitRepair& work, Journal* journal) {
  const Row row = rows_[index(d)];
  if (!is_mark(index(smallest_[row]))) open_row(row, kNoRow - 1, work, journal);
  if (journal != nullptr) journal->record_row(*this, d, row);
  rows_[index(d)] = kNoRow;
  ++work.visited_darts;
}

void OrbitIndex::open_row(Row row, std::uint32_t part, OrbitRepair& work, Journal* journal) {
  if (!is_mark(index(smallest_[row]))) {
    if (journal != nullptr) journal->record_smallest(*this, row);
    work.open_.push_back(row);
  }
  smallest_[row] = DartId{part};
}

void OrbitIndex::walk_part(const GMap& map, DartId d, OrbitRepair& work, Journal* journal) {
  const std::uint32_t mark = kMark | static_cast<std::uint32_t>(work.parts_.size());
  OrbitRepair::Part part{d, kNoRow, static_cast<std::uint32_t>(work.darts_.size()),
                         static_cast<std::uint32_t>(work.sources.size()), 0};
  Row last = kNoRow;
  part.row_of_smallest = rows_[index(d)];
  const auto visit = [&](DartId x) {
    const Row old = rows_[index(x)];
    if (journal != nullptr) journal->record_row(*this, x, old);
    rows_[index(x)] = mark;
    work.darts_.push_back(x);
    if (x < part.smallest) {
      part.smallest = x;
      part.row_of_smallest = old;
    }
    if (old == last) return;
    last = old;
    if (old == kNoRow || index(smallest_[old]) == mark) return;
    open_row(old, mark, work, journal);
    work.sources.push_back(old);
  };
  const detail::OrbitLinks links(map, type_);
  if (links.count <= 2) {
    detail::walk_linear(links, d, visit);
  } else {
    visit(d);
    for (std::size_t next = part.darts_begin; next < work.darts_.size(); ++next) {
      for (int k = 0; k < links.count; ++k) {
        const DartId x = links.alpha[k][index(work.darts_[next])];
        if (rows_[index(x)] != mark) visit(x);
      }
    }
  }
  part.sources_end = static_cast<std::uint32_t>(work.sources.size());
  std::sort(work.sources.begin() + part.sources_begin, work.sources.end());
  work.parts_.push_back(part);
}

void OrbitIndex::sort_parts(OrbitRepair& work) const {
  work.order_.clear();
  for (const auto& part : work.parts_) work.order_.push_back(index(part.smallest));
  sort_numbers(work.order_, static_cast<std::uint32_t>(rows_.size()), work.bits_);
}

Row OrbitIndex::claim_row(const OrbitRepair::Part& part) {
  Row row = part.row_of_smallest;
  if (row != kNoRow && is_mark(index(smallest_[row]))) {
    smallest_[row] = part.smallest;
    return row;
  }
  row = row_end();
  smallest_.push_back(part.smallest);
  ++alive_;
  return row;
}

void OrbitIndex::name_parts(OrbitRepair& work) {
  for (std::uint32_t smallest : work.order_) {
    const std::uint32_t number = rows_[smallest] & ~kMark;
    const OrbitRepair::Part& part = work.parts_[number];
    const std::size_t darts_end = number + 1 == work.parts_.size()
                                      ? work.darts_.size()
                                      : work.parts_[number + 1].darts_begin;
    const Row row = claim_row(part);
    for (std::size_t i = part.darts_begin; i < darts_end; ++i) rows_[index(work.darts_[i])] = row;
    const std::uint32_t sources = part.sources_end - part.sources_begin;
    work.orbits.push_back({row, part.smallest, part.sources_begin, sources});
    work.created += sources == 0;
    work.merged += sources > 1;
    work.split += sources > 0 && row != part.row_of_smallest;
  }
}

void OrbitIndex::close_rows(OrbitRepair& work) {
  std::erase_if(work.open_, [&](Row row) { return !is_mark(index(smallest_[row])); });
  sort_numbers(work.open_, row_end(), work.bits_);
  for (Row row : work.open_) smallest_[row] = kNoDart;
  alive_ -= static_cast<Row>(work.open_.size());
  work.removed.insert(work.removed.end(), work.open_.begin(), work.open_.end());
}

}  // namespace gmsim::gmap
