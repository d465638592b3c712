// SPDX-License-Identifier: MIT
#include "gmap/gmap.h"

#include "gmap/journal.h"
#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

void add_pair(std::vector<DartId>* touched, DartId a, DartId b) {
  if (touched == nullptr) return;
  touched->push_back(a);
  touched->push_back(b);
}

/// Follows one link from both darts of a pair. False when one is free and the other is not.
bool step_pair(const DartId* alpha, DartId& a, DartId& b, bool& moved) {
  const DartId next_a = alpha[index(a)], next_b = alpha[index(b)];
  moved = next_a != a;
  if (moved != (next_b != b)) return false;
  a = next_a;
  b = next_b;
  return true;
}

/// Calls visit(x, y) for the pairs that the isomorphism between two orbits of at most two links
/// puts together; stops and returns false when there is none or visit returns false.
template <class Visit>
bool walk_pairs(const detail::OrbitLinks& links, DartId a, DartId b, Visit&& visit) {
  if (!visit(a, b)) return false;
  if (links.count == 0) return true;
  const int last = links.count - 1;
  for (int start = 0; start <= last; ++start) {  // along the orbit one way, then the other
    DartId x = a, y = b;
    for (int k = start;; k = last - k) {
      bool moved = false;
      if (!step_pair(links.alpha[k], x, y, moved)) return false;
      if (!moved) break;
      if ((x == a) != (y == b)) return false;
      if (x == a) return true;  // both are cycles of the same length
      if (!visit(x, y)) return false;
      if (last == 0) return true;
    }
  }
  return true;
}

}  // namespace

GMap::GMap(int dimension) : dimension_(dimension) {
  GMSIM_CHECK(dimension >= 1 && dimension <= types::kMaxDimension, "a map has dimension 1, 2 or 3");
}

void GMap::reserve(std::uint32_t darts) {
  for (int i = 0; i <= dimension_; ++i) alpha_[i].reserve(darts);
}

DartId GMap::add_darts(std::uint32_t count) {
  const std::uint32_t first = dart_end();
  GMSIM_CHECK(count < 0x80000000u - first, "more than 2^31 darts");
  if (journal_ != nullptr) journal_->begin(*this);
  for (int i = 0; i <= dimension_; ++i) {
    alpha_[i].resize(first + count);
    DartId* const links = alpha_[i].data();
    for (std::uint32_t d = first; d < first + count; ++d) links[d] = DartId{d};
  }
  alive_ += count;
  return DartId{first};
}

std::span<DartId> GMap::new_links(int i, DartId first) {
  GMSIM_CHECK(journal_ == nullptr || journal_->is_new(first), "dart is older than the journal");
  return std::span(alpha_[i]).subspan(index(first));
}

void GMap::drop_links(DartId d) {
  GMSIM_CHECK(alive(d), "dart to remove is not alive");
  for (int i = 0; i <= dimension_; ++i) set_alpha(i, d, kNoDart);
  --alive_;
}

void GMap::check_unreachable(DartId d, std::span<const DartId> neighbours) const {
  for (int i = 0; i <= dimension_; ++i) {
    GMSIM_CHECK(!alive(neighbours[i]) || alpha(i, neighbours[i]) != d,
                "an alive dart is linked to a removed one");
  }
}

void GMap::remove_dart(DartId d) {
  remove_darts({&d, 1});
}

void GMap::remove_darts(std::span<const DartId> darts) {
  using Links = std::array<DartId, types::kMaxDimension + 1>;
  std::array<Links, 32> few;
  std::vector<Links> many(darts.size() > few.size() ? darts.size() : 0);
  Links* const neighbours = many.empty() ? few.data() : many.data();
  for (std::size_t k = 0; k < darts.size(); ++k) {
    for (int i = 0; i <= dimension_; ++i) neighbours[k][i] = alpha(i, darts[k]);
    drop_links(darts[k]);
  }
  for (std::size_t k = 0; k < darts.size(); ++k) check_unreachable(darts[k], neighbours[k]);
}

bool GMap::can_sew(int i, DartId a, DartId b) const {
  const detail::OrbitLinks links(*this, sew_type(i));
  return walk_pairs(links, a, b,
                    [&](DartId x, DartId y) { return is_free(i, x) && is_free(i, y) && x != b; });
}

bool GMap::sew(int i, DartId a, DartId b, std::vector<DartId>* touched) {
  const OrbitType type = sew_type(i);
  if (type.is_single()) return sew_edges(i, type.first(), a, b, touched);
  if (!can_sew(i, a, b)) return false;
  walk_pairs(detail::OrbitLinks(*this, type), a, b, [&](DartId x, DartId y) {
    set_pair(i, x, y, y, x);
    add_pair(touched, x, y);
    return true;
  });
  return true;
}

bool GMap::sew_edges(int i, int along, DartId a, DartId b, std::vector<DartId>* touched) {
  const DartId end_a = alpha(along, a), end_b = alpha(along, b);
  if (a == b || end_a == b || (end_a == a) != (end_b == b)) return false;
  if (!is_free(i, a) || !is_free(i, b) || !is_free(i, end_a) || !is_free(i, end_b)) return false;
  set_pair(i, a, b, b, a);
  add_pair(touched, a, b);
  if (end_a == a) return true;
  set_pair(i, end_a, end_b, end_b, end_a);
  add_pair(touched, end_a, end_b);
  return true;
}

void GMap::unsew(int i, DartId a, std::vector<DartId>* touched) {
  const OrbitType type = sew_type(i);
  const auto free_pair = [&](DartId x) {
    const DartId y = alpha(i, x);
    if (y == x) return;
    set_pair(i, x, x, y, y);
    add_pair(touched, x, y);
  };
  if (!type.is_single()) return detail::walk_linear(detail::OrbitLinks(*this, type), a, free_pair);
  const DartId end = alpha(type.first(), a);
  free_pair(a);
  free_pair(end);
}

void GMap::record_alpha(int i, DartId d) {
  journal_->record(*this, i, d);
}

void GMap::record_pair(int i, DartId a, DartId b) {
  journal_->record(*this, i, a);
  journal_->record(*this, i, b);
}

std::size_t GMap::memory_bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const auto& alpha : alpha_) bytes += alpha.capacity() * sizeof(DartId);
  return bytes;
}

}  // namespace gmsim::gmap
