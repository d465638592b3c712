// SPDX-License-Identifier: MIT
#include "gmap/journal.h"

#include <algorithm>

namespace gmsim::gmap {

struct Journal::MapLog {
  struct Link {
    DartId dart;
    DartId old;
    std::uint8_t dimension;
  };
  bool active = false;
  std::uint32_t dart_end = 0, alive = 0;
  std::vector<Link> links = {};
};

struct Journal::IndexLog {
  struct RowOfDart {
    DartId dart;
    Row old;
  };
  struct SmallestOfRow {
    Row row;
    DartId old;
  };
  OrbitIndex* index = nullptr;
  bool active = false;
  std::size_t dart_end = 0;
  Row row_end = 0, alive = 0;
  std::vector<RowOfDart> rows = {};
  std::vector<SmallestOfRow> smallest = {};
};

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
  if (map_.empty()) map_.emplace_back();
  MapLog& log = map_.front();
  if (log.active) return;
  log.active = true;
  log.dart_end = map.dart_end();
  log.alive = map.dart_count();
}

bool Journal::is_new(DartId d) const {
  return !map_.empty() && map_.front().active && gmap::index(d) >= map_.front().dart_end;
}

void Journal::record(const GMap& map, int i, DartId d) {
  begin(map);
  MapLog& log = map_.front();
  if (gmap::index(d) >= log.dart_end) return;
  log.links.push_back({d, map.alpha(i, d), static_cast<std::uint8_t>(i)});
}

Journal::IndexLog& Journal::log(OrbitIndex& index) {
  if (last_index_ < indices_.size()) {  // one index is repaired after the other
    IndexLog& last = indices_[last_index_];
    if (last.index == &index && last.active) return last;
  }
  auto found = std::find_if(indices_.begin(), indices_.end(),
                            [&](const IndexLog& log) { return log.index == &index; });
  if (found == indices_.end()) found = indices_.insert(indices_.end(), IndexLog{&index});
  last_index_ = static_cast<std::size_t>(found - indices_.begin());
  if (found->active) return *found;
  found->active = true;
  found->dart_end = index.rows_.size();
  found->row_end = index.row_end();
  found->alive = index.orbit_count();
  return *found;
}

void Journal::begin(OrbitIndex& index) {
  log(index);
}

void Journal::record_row(OrbitIndex& index, DartId d, Row old) {
  IndexLog& entry = log(index);
  if (gmap::index(d) < entry.dart_end) entry.rows.push_back({d, old});
}

void Journal::record_smallest(OrbitIndex& index, Row row, DartId old) {
  IndexLog& entry = log(index);
  if (row < entry.row_end) entry.smallest.push_back({row, old});
}

Journal::ColumnLog& Journal::log(EmbeddingColumn& column) {
  auto found = std::find_if(columns_.begin(), columns_.end(),
                            [&](const ColumnLog& log) { return log.column == &column; });
  if (found == columns_.end()) found = columns_.insert(columns_.end(), ColumnLog{&column});
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
  for (const MapLog& log : map_) {
    if (!log.active) continue;
    for (auto link = log.links.rbegin(); link != log.links.rend(); ++link) {
      map.alpha_[link->dimension][gmap::index(link->dart)] = link->old;
    }
    for (int i = 0; i <= map.dimension(); ++i) map.alpha_[i].resize(log.dart_end);
    map.alive_ = log.alive;
  }
  for (const IndexLog& log : indices_) {
    if (!log.active) continue;
    OrbitIndex& index = *log.index;
    for (auto row = log.rows.rbegin(); row != log.rows.rend(); ++row) {
      index.rows_[gmap::index(row->dart)] = row->old;
    }
    for (auto entry = log.smallest.rbegin(); entry != log.smallest.rend(); ++entry) {
      index.smallest_[entry->row] = entry->old;
    }
    index.rows_.resize(log.dart_end);
    index.smallest_.resize(log.row_end);
    index.alive_ = log.alive;
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
  for (MapLog& log : map_) {
    log.active = false;
    log.links.clear();
  }
  for (IndexLog& log : indices_) {
    log.active = false;
    log.rows.clear();
    log.smallest.clear();
  }
  for (ColumnLog& log : columns_) {
    log.active = false;
    log.values.clear();
    log.data.clear();
  }
}

std::size_t Journal::size() const {
  std::size_t count = 0;
  for (const MapLog& log : map_) count += log.links.size();
  for (const IndexLog& log : indices_) count += log.rows.size() + log.smallest.size();
  for (const ColumnLog& log : columns_) count += log.values.size();
  return count;
}

}  // namespace gmsim::gmap
