// SPDX-License-Identifier: MIT
#include "gmap/journal.h"

#include <algorithm>

namespace gmsim::gmap {

struct Journal::ColumnLog {
  struct Value {
    Row row;
    std::uint8_t present;
  };
  EmbeddingColumn* column = nullptr;
  bool active = false;
  Row row_end = 0;
  std::vector<Value> values = {};
  std::vector<double> data = {};  // `stride` for each of `values`
};

Journal::Journal() = default;
Journal::~Journal() = default;

void Journal::begin(const GMap& map) {
  if (map_.active) return;
  map_.active = true;
  map_.dart_end = map.dart_end();
  map_.alive = map.dart_count();
}

Journal::IndexLog& Journal::log(OrbitIndex& index) {
  if (last_index_ < indices_.size()) {  // one index is repaired after the other
    IndexLog& last = indices_[last_index_];
    if (last.index_ == &index && last.active_) return last;
  }
  auto found = std::find_if(indices_.begin(), indices_.end(),
                            [&](const IndexLog& log) { return log.index_ == &index; });
  if (found == indices_.end()) found = indices_.insert(indices_.end(), IndexLog{index});
  last_index_ = static_cast<std::size_t>(found - indices_.begin());
  if (found->active_) return *found;
  found->active_ = true;
  found->dart_end_ = index.rows_.size();
  found->row_end_ = index.row_end();
  found->alive_ = index.orbit_count();
  return *found;
}

Journal::ColumnLog& Journal::log(EmbeddingColumn& column) {
  if (last_column_ < columns_.size()) {
    ColumnLog& last = columns_[last_column_];
    if (last.column == &column && last.active) return last;
  }
  auto found = std::find_if(columns_.begin(), columns_.end(),
                            [&](const ColumnLog& log) { return log.column == &column; });
  if (found == columns_.end()) found = columns_.insert(columns_.end(), ColumnLog{&column});
  last_column_ = static_cast<std::size_t>(found - columns_.begin());
  if (found->active) return *found;
  found->active = true;
  found->row_end = column.row_end();
  return *found;
}

void Journal::begin(EmbeddingColumn& column) {
  log(column);
}

void Journal::record(EmbeddingColumn& column, Row row) {
  ColumnLog& entry = log(column);
  if (row >= entry.row_end) return;
  const auto value = column.get(row);
  entry.values.push_back({row, column.present_[row]});
  entry.data.insert(entry.data.end(), value.begin(), value.end());
}

void Journal::roll_back(GMap& map, EmbeddingStore& store) {
  if (map_.active) {
    for (auto link = map_.links.rbegin(); link != map_.links.rend(); ++link) {
      map.alpha_[link->dimension][gmap::index(link->dart)] = link->old;
    }
    for (int i = 0; i <= map.dimension(); ++i) map.alpha_[i].resize(map_.dart_end);
    map.alive_ = map_.alive;
  }
  for (const IndexLog& log : indices_) {
    if (!log.active_) continue;
    OrbitIndex& index = *log.index_;
    for (auto row = log.rows_.rbegin(); row != log.rows_.rend(); ++row) {
      index.rows_[gmap::index(row->dart)] = row->old;
    }
    for (auto entry = log.smallest_.rbegin(); entry != log.smallest_.rend(); ++entry) {
      index.smallest_[entry->row] = entry->old;
    }
    index.rows_.resize(log.dart_end_);
    index.smallest_.resize(log.row_end_);
    index.alive_ = log.alive_;
  }
  for (const ColumnLog& log : columns_) {
    if (!log.active) continue;
    EmbeddingColumn& column = *log.column;
    for (std::size_t i = log.values.size(); i-- > 0;) {
      const auto [row, present] = log.values[i];
      column.present_[row] = present;
      std::copy_n(log.data.begin() + static_cast<std::ptrdiff_t>(i * column.stride_),
                  column.stride_, column.data_.begin() + std::ptrdiff_t{row} * column.stride_);
    }
    column.resize(log.row_end);
  }
  store.trim_columns();
  commit();
}

void Journal::commit() {
  map_.active = false;
  map_.links.clear();
  for (IndexLog& log : indices_) {
    log.active_ = false;
    log.rows_.clear();
    log.smallest_.clear();
  }
  for (ColumnLog& log : columns_) {
    log.active = false;
    log.values.clear();
    log.data.clear();
  }
}

std::size_t Journal::size() const {
  std::size_t count = map_.links.size();
  for (const IndexLog& log : indices_) count += log.rows_.size() + log.smallest_.size();
  for (const ColumnLog& log : columns_) count += log.values.size();
  return count;
}

}  // namespace gmsim::gmap
