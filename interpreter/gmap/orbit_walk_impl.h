// SPDX-License-Identifier: MIT
// The templates of orbit_walk.h; include that header instead.
#pragma once

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "gmap/gmap.h"
#include "gmap/orbit_walk.h"

namespace gmsim::gmap::detail {

/// The links of an orbit type, ascending, as raw arrays.
struct OrbitLinks {
  OrbitLinks(const GMap& map, OrbitType type) {
    GMSIM_CHECK(type.bits() >> (map.dimension() + 1) == 0, "orbit type has a link the map lacks");
    for (unsigned bits = type.bits(); bits != 0; bits &= bits - 1) {
      alpha[count++] = map.alphas(std::countr_zero(bits)).data();
    }
  }

  std::array<const DartId*, types::kMaxDimension + 1> alpha{};
  int count = 0;
};

/// Walks an orbit of two links, which is a path or a cycle, by alternating between them.
template <class Visitor>
[[gnu::always_inline]] inline void walk_alternating(const DartId* first, const DartId* second,
                                                    DartId d, Visitor&& f) {
  f(d);
  DartId x = d;
  while (true) {
    const DartId y = first[index(x)];
    if (y == x) break;
    f(y);
    x = second[index(y)];
    if (x == d) return;  // a cycle, closed
    if (x == y) break;
    f(x);
  }
  x = d;
  while (true) {  // a path: the part on the other side of d
    const DartId y = second[index(x)];
    if (y == x) return;
    f(y);
    x = first[index(y)];
    if (x == y) return;
    f(x);
  }
}

/// Walks an orbit of at most two links.
template <class Visitor>
[[gnu::always_inline]] inline void walk_linear(const OrbitLinks& links, DartId d, Visitor&& f) {
  if (links.count == 2) return walk_alternating(links.alpha[0], links.alpha[1], d, f);
  f(d);
  if (links.count == 0) return;
  const DartId other = links.alpha[0][index(d)];
  if (other != d) f(other);
}

/// Darts in the order in which they were added, each once: the queue and the marks of a breadth
/// first walk. Orbits of up to kInline darts need no allocation.
class DartQueue {
 public:
  DartQueue() { slots_.fill(kNoDart); }
  DartQueue(const DartQueue&) = delete;
  DartQueue& operator=(const DartQueue&) = delete;

  /// True when the dart was not there yet.
  bool push(DartId d) {
    DartId* slot = find(d);
    if (*slot == d) return false;
    *slot = d;
    *(end_++) = d;
    if (size() == capacity_) grow();
    return true;
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  [[nodiscard]] DartId operator[](std::size_t i) const { return begin_[i]; }

 private:
  static constexpr std::size_t kInline = 128;
  static constexpr int kInlineBits = 8;

  /// The slot of a dart, or the empty one where it belongs (open addressing, Fibonacci hashing:
  /// the darts of an orbit often differ by multiples of a power of two).
  [[nodiscard]] DartId* find(DartId d) const {
    std::size_t i = (index(d) * 0x9e3779b1u) >> (32 - table_bits_);
    while (table_[i] != kNoDart && table_[i] != d) i = (i + 1) & ((1u << table_bits_) - 1);
    return table_ + i;
  }
  void grow() {
    const std::size_t count = size();
    std::vector<DartId> darts(begin_, end_);
    capacity_ *= 4;
    table_bits_ += 2;
    darts.resize(capacity_);
    heap_darts_ = std::move(darts);
    begin_ = heap_darts_.data();
    end_ = begin_ + count;
    heap_slots_.assign(std::size_t{1} << table_bits_, kNoDart);
    table_ = heap_slots_.data();
    for (const DartId* d = begin_; d != end_; ++d) *find(*d) = *d;
  }

  std::array<DartId, kInline> darts_;
  std::array<DartId, (1u << kInlineBits)> slots_;
  std::vector<DartId> heap_darts_, heap_slots_;
  DartId* begin_ = darts_.data();
  DartId* end_ = begin_;
  DartId* table_ = slots_.data();
  std::size_t capacity_ = kInline;
  int table_bits_ = kInlineBits;
};

}  // namespace gmsim::gmap::detail

namespace gmsim::gmap {

template <class Visitor>
void for_each_dart(const GMap& map, OrbitType type, DartId d, Visitor&& f) {
  const detail::OrbitLinks links(map, type);
  if (links.count <= 2) return detail::walk_linear(links, d, f);
  detail::DartQueue queue;
  queue.push(d);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const DartId x = queue[i];
    f(x);
    for (int k = 0; k < links.count; ++k) queue.push(links.alpha[k][index(x)]);
  }
}

template <class Smallest>
std::vector<DartId> quotient(const GMap& map, OrbitType outer, DartId d, Smallest&& smallest) {
  std::vector<std::pair<DartId, DartId>> members;  // smallest dart of the inner orbit, dart
  for_each_dart(map, outer, d, [&](DartId x) { members.emplace_back(smallest(x), x); });
  std::sort(members.begin(), members.end());
  std::vector<DartId> darts;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i == 0 || members[i].first != members[i - 1].first) darts.push_back(members[i].second);
  }
  std::sort(darts.begin(), darts.end());
  return darts;
}

}  // namespace gmsim::gmap
