// SPDX-License-Identifier: MIT
#include "gmap/orbit_index.h"

#include "gmap/journal.h"
#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

/// Gives the orbit of d the row `row`. `queue` is work space.
void fill_orbit(const detail::OrbitLinks& links, DartId d, Row row, std::vector<Row>& rows,
                std::vector<DartId>& queue) {
  if (links.count <= 2) {
    return detail::walk_linear(links, d, [&](DartId x) { rows[index(x)] = row; });
  }
  queue.assign(1, d);
  rows[index(d)] = row;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (int k = 0; k < links.count; ++k) {
      const DartId x = links.alpha[k][index(queue[next])];
      if (rows[index(x)] == row) continue;
      rows[index(x)] = row;
      queue.push_back(x);
    }
  }
}

}  // namespace

OrbitIndex::OrbitIndex(const GMap& map, OrbitType type)
    : type_(type), rows_(map.dart_end(), kNoRow) {
  const detail::OrbitLinks links(map, type);
  two_links_ = links.count == 2;
  if (two_links_) {
    first_link_ = type.first();
    second_link_ = OrbitType::from_bits(type.bits() & (type.bits() - 1)).first();
  }
  std::vector<DartId> queue;
  for (std::uint32_t i = 0; i < map.dart_end(); ++i) {
    if (rows_[i] != kNoRow || !map.alive(DartId{i})) continue;
    fill_orbit(links, DartId{i}, row_end(), rows_, queue);
    smallest_.push_back(DartId{i});
  }
  smallest_.shrink_to_fit();
  alive_ = row_end();
}

namespace {

/// Gives the darts with row `from` on the path from d, which starts with link `first`, the row
/// `to`.
inline void rename_path(const DartId* first, const DartId* second, DartId d, Row from, Row to,
                        Row* rows) {
  while (true) {
    d = first[index(d)];
    if (rows[index(d)] != from) return;
    rows[index(d)] = to;
    d = second[index(d)];
    if (rows[index(d)] != from) return;
    rows[index(d)] = to;
  }
}

}  // namespace

Row OrbitIndex::merge_rows(const GMap& map, DartId a, DartId b, Journal* journal) {
  if (smallest(row(b)) < smallest(row(a))) std::swap(a, b);
  const Row kept = row(a), gone = row(b);
  if (journal != nullptr || !two_links_) {
    rename(map, b, gone, kept, journal);
  } else {
    const DartId* const first = map.alphas(first_link_).data();
    const DartId* const second = map.alphas(second_link_).data();
    Row* const rows = rows_.data();
    rows[index(b)] = kept;
    rename_path(first, second, b, gone, kept, rows);
    rename_path(second, first, b, gone, kept, rows);
  }
  smallest_[gone] = kNoDart;
  --alive_;
  return gone;
}

/// Walks from d through the darts with row `from`.
void OrbitIndex::rename(const GMap& map, DartId d, Row from, Row to, Journal* journal) {
  if (journal != nullptr) journal->log(*this).record_smallest(from, smallest_[from]);
  const detail::OrbitLinks links(map, type_);
  std::vector<DartId> queue{d};
  add_dart(d, to, journal);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (int k = 0; k < links.count; ++k) {
      const DartId x = links.alpha[k][index(queue[next])];
      if (rows_[index(x)] != from) continue;
      add_dart(x, to, journal);
      queue.push_back(x);
    }
  }
}

void OrbitIndex::grow(const GMap& map, Journal* journal) {
  if (journal != nullptr) journal->log(*this);
  rows_.resize(map.dart_end(), kNoRow);
}

void OrbitIndex::reserve(std::uint32_t darts, Row orbits) {
  rows_.reserve(darts);
  smallest_.reserve(orbits);
}

void OrbitIndex::record_row(DartId d, Journal& journal) {
  journal.log(*this).record_row(d, row(d));
}

std::size_t OrbitIndex::memory_bytes() const {
  return sizeof(*this) + rows_.capacity() * sizeof(Row) + smallest_.capacity() * sizeof(DartId);
}

}  // namespace gmsim::gmap
