// SPDX-License-Identifier: MIT
#include "engine/match_table.h"

#include <algorithm>
#include <utility>

namespace gmsim::engine {

MatchTable::MatchTable(Widths widths)
    : widths_(std::move(widths)), rows_(widths_.roles), own_(widths_.own.size()) {}

MatchTable::OwnColumn MatchTable::own(std::uint32_t offset) const {
  std::size_t value = 0;
  while (offset >= widths_.own[value]) offset -= widths_.own[value++];
  return {own_[value].data() + offset, widths_.own[value]};
}

std::size_t MatchTable::bytes_per_match() const {
  std::size_t bytes = sizeof(DartId) * (1 + widths_.nodes + widths_.targets) + 1 +
                      sizeof(Row) * widths_.roles;
  for (const std::uint32_t width : widths_.own) bytes += sizeof(double) * width;
  return bytes;
}

void MatchTable::add_own(std::span<const double> numbers) {
  for (std::size_t value = 0; value < own_.size(); ++value) {
    const std::span<const double> part = numbers.first(widths_.own[value]);
    own_[value].insert(own_[value].end(), part.begin(), part.end());
    numbers = numbers.subspan(part.size());
  }
}

std::uint32_t MatchTable::add(const ForceMatch& match) {
  keys_.push_back(match.key);
  ways_.push_back(match.roles.way);
  const std::size_t orbits = match.roles.roles.size();
  for (std::uint32_t role = 0; role < widths_.roles; ++role)
    rows_[role].push_back(role < orbits ? match.roles.roles[role].row
                                        : match.roles.atomic[role - orbits]);
  add_own(match.own);
  nodes_.insert(nodes_.end(), match.nodes.begin(), match.nodes.end());
  targets_.insert(targets_.end(), match.roles.targets.begin(), match.roles.targets.end());
  return size() - 1;
}

std::uint32_t MatchTable::add(DartId key, std::span<const Row> rows, std::span<const double> own) {
  keys_.push_back(key);
  ways_.push_back(compile::MatchRoles::kNoWay);
  for (std::uint32_t role = 0; role < widths_.roles; ++role) rows_[role].push_back(rows[role]);
  add_own(own);
  return size() - 1;
}

void MatchTable::set_own(std::uint32_t row, std::span<const double> own) {
  for (std::size_t value = 0; value < own_.size(); ++value) {
    const std::uint32_t width = widths_.own[value];
    std::copy_n(own.begin(), width, own_[value].begin() + std::ptrdiff_t{width} * row);
    own = own.subspan(width);
  }
}

void MatchTable::vacate(std::uint32_t row) {
  keys_[row] = gmap::kNoDart;
  ++vacant_;
}

namespace {

/// Rows of `width` entries each.
template <typename Entry>
void keep(std::vector<Entry>& column, std::span<const std::uint32_t> rows, std::uint32_t width) {
  if (column.empty()) return;
  std::vector<Entry> kept;
  kept.reserve(rows.size() * width);
  for (const std::uint32_t row : rows) {
    const auto first = column.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * width);
    kept.insert(kept.end(), first, first + width);
  }
  column = std::move(kept);
}

}  // namespace

void MatchTable::pack(std::span<const std::uint32_t> rows) {
  keep(keys_, rows, 1);
  keep(ways_, rows, 1);
  for (auto& column : rows_) keep(column, rows, 1);
  for (std::size_t k = 0; k < own_.size(); ++k) keep(own_[k], rows, widths_.own[k]);
  keep(nodes_, rows, widths_.nodes);
  keep(targets_, rows, widths_.targets);
  vacant_ = 0;
}

void MatchTable::clear() { *this = MatchTable(widths_); }

ForceMatch MatchTable::match(std::uint32_t row, std::uint32_t shape) const {
  ForceMatch result;
  result.key = keys_[row];
  result.shape = shape;
  result.nodes.assign(nodes(row).begin(), nodes(row).end());
  result.roles.targets.assign(targets(row).begin(), targets(row).end());
  for (const auto& column : rows_) result.roles.roles.push_back({{}, gmap::kNoDart, column[row]});
  for (std::size_t k = 0; k < own_.size(); ++k) {
    const auto begin = own_[k].begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * widths_.own[k]);
    result.own.insert(result.own.end(), begin, begin + widths_.own[k]);
  }
  return result;
}

}  // namespace gmsim::engine
