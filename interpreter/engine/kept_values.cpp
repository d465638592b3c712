// SPDX-License-Identifier: MIT
#include "engine/kept_values.h"

#include <bit>

namespace gmsim::engine {

void KeptValues::clear() {
  numbers_.clear();
  used_ = 0;
  if (++epoch_ != 0) return;
  cells_.assign(cells_.size(), Cell{});
  epoch_ = 1;
}

std::size_t KeptValues::place(std::uint64_t key) const {
  const std::size_t mask = cells_.size() - 1;
  const int shift = 64 - std::countr_zero(cells_.size());
  std::size_t i = (key * 0x9e3779b97f4a7c15u) >> shift;
  while (cells_[i].epoch == epoch_ && cells_[i].key != key) i = (i + 1) & mask;
  return i;
}

const double* KeptValues::find(std::uint32_t function, types::DartId dart) const {
  const Cell& cell = cells_[place(key(function, dart))];
  return cell.epoch == epoch_ ? numbers_.data() + cell.value : nullptr;
}

std::uint32_t KeptValues::add(std::span<const double> value) {
  const auto begin = static_cast<std::uint32_t>(numbers_.size());
  numbers_.insert(numbers_.end(), value.begin(), value.end());
  return begin;
}

void KeptValues::set(std::uint32_t function, types::DartId dart, std::uint32_t value) {
  Cell& cell = cells_[place(key(function, dart))];
  if (cell.epoch != epoch_) ++used_;
  cell = {key(function, dart), epoch_, value};
  if (2 * used_ > cells_.size()) grow();
}

void KeptValues::grow() {
  std::vector<Cell> old(2 * cells_.size());
  old.swap(cells_);
  for (const Cell& cell : old) {
    if (cell.epoch == epoch_) cells_[place(cell.key)] = cell;
  }
}

}  // namespace gmsim::engine
