// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/check.h"
#include "types/orbit_type.h"

namespace gmsim::gmap {

using types::DartId;
using types::index;
using types::kNoDart;
using types::OrbitType;

class Journal;

/// An n-dimensional generalized map, n = 1, 2 or 3: darts and one involution per dimension
/// (theory 1.1). alpha(i, d) == d means that d is i-free. Dead darts keep their id and have
/// alpha(0, d) == kNoDart.
///
/// Ids are given out in ascending order and never again, so a dart that existed before a change is
/// smaller than one the change made.
///
/// The single-pair forms link/unlink/set_alpha may leave the map invalid in between; sew/unsew keep
/// the cycle condition alpha_i alpha_j = alpha_j alpha_i for i + 2 <= j.
class GMap {
 public:
  explicit GMap(int dimension);

  [[nodiscard]] int dimension() const { return dimension_; }
  /// One past the largest dart id ever used.
  [[nodiscard]] std::uint32_t dart_end() const {
    return static_cast<std::uint32_t>(alpha_[0].size());
  }
  [[nodiscard]] std::uint32_t dart_count() const { return alive_; }
  [[nodiscard]] bool alive(DartId d) const {
    return index(d) < dart_end() && alpha_[0][index(d)] != kNoDart;
  }

  [[nodiscard]] DartId alpha(int i, DartId d) const { return alpha_[i][index(d)]; }
  [[nodiscard]] bool is_free(int i, DartId d) const { return alpha(i, d) == d; }
  /// The involution of one dimension as an array over all darts, dead ones included.
  [[nodiscard]] std::span<const DartId> alphas(int i) const { return alpha_[i]; }

  void reserve(std::uint32_t darts);
  /// New dart, free in every dimension.
  DartId add_dart() { return add_darts(1); }
  /// `count` consecutive new darts; returns the first.
  DartId add_darts(std::uint32_t count);
  /// Marks a dart dead. Nothing alive may be linked to it any more; its own links are dropped.
  void remove_dart(DartId d);
  /// Marks several darts dead, each given once; they may still be linked to each other.
  void remove_darts(std::span<const DartId> darts);

  /// Single pair: both darts must be i-free (link) or linked (unlink).
  void link(int i, DartId a, DartId b) {
    GMSIM_CHECK(a != b && is_free(i, a) && is_free(i, b), "darts to link must differ and be free");
    set_pair(i, a, b, b, a);
  }
  void unlink(int i, DartId a) {
    const DartId b = alpha(i, a);
    GMSIM_CHECK(a != b && alpha(i, b) == a, "dart to unlink is free");
    set_pair(i, a, a, b, b);
  }
  /// Raw write of one entry; the caller restores the involution.
  void set_alpha(int i, DartId d, DartId value) {
    if (journal_ != nullptr) record_alpha(i, d);
    alpha_[i][index(d)] = value;
  }

  /// The links of the darts from `first` on for direct writing, in place of set_alpha: they must be
  /// new since the journal, if any, began, since what is new needs no record. Gone at the next
  /// add_darts.
  [[nodiscard]] std::span<DartId> new_links(int i, DartId first);

  /// The orbit <0..i-2, i+2..n> whose darts are linked together by sew and unsew in dimension i.
  [[nodiscard]] OrbitType sew_type(int i) const {
    const unsigned all = (2u << dimension_) - 1, near = (7u << i) >> 1;  // i-1, i, i+1
    return OrbitType::from_bits(static_cast<std::uint8_t>(all & ~near));
  }

  /// True when sew(i, a, b) is possible: the orbits <0..i-2, i+2..n> of a and b are isomorphic with
  /// a on b, disjoint, and all their darts i-free.
  [[nodiscard]] bool can_sew(int i, DartId a, DartId b) const;
  /// Links the orbits of a and b pair by pair. Returns false, changing nothing, when impossible.
  /// `touched`, when given, receives every dart whose link changed.
  bool sew(int i, DartId a, DartId b, std::vector<DartId>* touched = nullptr);
  /// Unlinks the orbit <0..i-2, i+2..n> of a from its i-neighbours.
  void unsew(int i, DartId a, std::vector<DartId>* touched = nullptr);

  /// While set, every change is recorded so that it can be undone.
  void set_journal(Journal* journal) { journal_ = journal; }
  [[nodiscard]] Journal* journal() const { return journal_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Journal;
  void record_alpha(int i, DartId d);
  void record_pair(int i, DartId a, DartId b);
  /// sew for orbits of one link, `along`: edges and the like, by far the most frequent.
  bool sew_edges(int i, int along, DartId a, DartId b, std::vector<DartId>* touched);
  void set_pair(int i, DartId a, DartId value_a, DartId b, DartId value_b) {
    if (journal_ != nullptr) record_pair(i, a, b);
    DartId* const links = alpha_[i].data();
    links[index(a)] = value_a;
    links[index(b)] = value_b;
  }
  void drop_links(DartId d);
  void check_unreachable(DartId d, std::span<const DartId> neighbours) const;

  int dimension_;
  std::uint32_t alive_ = 0;
  std::array<std::vector<DartId>, types::kMaxDimension + 1> alpha_;
  Journal* journal_ = nullptr;
};

}  // namespace gmsim::gmap
