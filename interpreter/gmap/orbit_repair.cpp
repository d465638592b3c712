// SPDX-License-Identifier: MIT
// OrbitIndex::repair. Orbits get their rows by ascending smallest dart: an orbit takes the former
// row of its smallest dart unless an earlier one has taken it. There are two ways to get there.
// When few darts are touched, their orbits are walked and put in order first. When a good part of
// the map is touched, all darts are gone through in order, so that the first dart met of an orbit
// is its smallest, and every orbit is walked and named at once.
#include <algorithm>

#include "gmap/journal.h"
#include "gmap/orbit_index.h"
#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

constexpr std::uint32_t kManyTouched = 8;  // one dart in so many: go through the whole map

// While a repair runs, the arrays of the index hold marks beside rows and smallest darts.
constexpr Row kWalked = kNoRow - 1;             // a dart whose orbit was walked and has no row yet
constexpr Row kTouched = kNoRow - 1;            // in the new rows: touched, not walked yet
constexpr std::uint32_t kMarked = 0x80000000u;  // on smallest darts, which are below it

constexpr bool marked(DartId d) {
  return d != kNoDart && index(d) >= kMarked;
}
constexpr DartId mark(DartId d) {
  return DartId{index(d) | kMarked};
}
constexpr DartId unmark(DartId d) {
  return DartId{index(d) & ~kMarked};
}

/// The former rows of an orbit but the one that the caller knows; most often none to three.
class OtherRows {
 public:
  [[nodiscard]] bool empty() const { return count_ == 0; }
  void clear() {
    count_ = 0;
    many_.clear();
  }
  /// `row` may have been added before.
  void add(Row row) {
    if (row == kNoRow || (count_ > 0 && few_[count_ - 1] == row)) return;
    if (count_ < kFew) {
      few_[count_++] = row;
    } else {
      many_.push_back(row);
    }
  }
  /// Appends `first`, unless it is kNoRow, and the others, ascending and each once.
  void write(Row first, std::vector<Row>& out) const {
    const std::size_t begin = out.size();
    if (first != kNoRow) out.push_back(first);
    for (std::uint32_t i = 0; i < count_; ++i) insert(few_[i], begin, out);
    if (many_.empty()) return;
    out.insert(out.end(), many_.begin(), many_.end());
    const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(from, out.end());
    out.erase(std::unique(from, out.end()), out.end());
  }

 private:
  /// Puts a row in its place in the ascending rows from `begin`, unless it is there.
  static void insert(Row row, std::size_t begin, std::vector<Row>& out) {
    std::size_t place = out.size();
    while (place > begin && out[place - 1] > row) --place;
    if (place > begin && out[place - 1] == row) return;
    out.push_back(row);
    Row* const rows = out.data();
    for (std::size_t k = out.size() - 1; k > place; --k) rows[k] = rows[k - 1];
    rows[place] = row;
  }

  static constexpr std::uint32_t kFew = 16;
  std::array<Row, kFew> few_;
  std::uint32_t count_ = 0;
  std::vector<Row> many_;
};

}  // namespace

/// One repair of one index.
class OrbitRepairer {
 public:
  OrbitRepairer(OrbitIndex& orbit_index, const GMap& map, OrbitRepair& done, RepairSpace& work,
                Journal* journal)
      : index_(orbit_index), map_(map), done_(done), work_(work),
        log_(journal != nullptr ? &journal->log(orbit_index) : nullptr),
        links_(map, index_.type_) {
    index_.rows_.resize(map.dart_end(), kNoRow);
  }

  void repair_few(std::span<const DartId> touched, const KnownOrbits& known) {
    work_.parts_.clear();
    work_.open_.clear();
    list_known(known);
    for (DartId d : touched) {
      GMSIM_CHECK(index(d) < map_.dart_end(), "touched dart is not of this map");
      if (row(d) == kWalked) continue;
      if (map_.alive(d)) {
        walk_part(d);
      } else if (row(d) != kNoRow) {
        drop(d);
      }
    }
    sort_parts();
    for (const RepairSpace::Part& part : work_.parts_) name_part(part);
    close_rows();
  }

  /// Where all changed orbits are known no dart need be marked.
  void repair_known(const KnownOrbits& known) {
    work_.parts_.clear();
    work_.open_.clear();
    const Row* const rows = index_.rows_.data();
    const DartId* const darts = known.darts.data();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : known.ends) {
      DartId least = darts[begin];
      Row last = kNoRow;
      for (std::uint32_t k = begin; k < end; ++k) {
        least = std::min(least, darts[k]);
        const Row old = rows[index(darts[k])];
        if (old == last || old == kNoRow) continue;
        last = old;
        open_row(old);
      }
      work_.parts_.push_back({least, begin, end});
      begin = end;
    }
    done_.visited_darts += known.darts.size();
    sort_parts();
    for (const RepairSpace::Part& part : work_.parts_) {
      name_known(known.darts.subspan(part.darts_begin, part.darts_end - part.darts_begin),
                 part.smallest);
    }
    close_rows();
  }

  void repair_many(std::span<const DartId> touched, std::span<const DartId> known) {
    work_.new_rows_.assign(map_.dart_end(), kNoRow);
    mark_touched(touched);
    mark_touched(known);
    if (links_.count == 2) {
      name_all([&](DartId d, auto&& visit) {
        detail::walk_alternating(links_.alpha[0], links_.alpha[1], d, visit);
      });
    } else if (links_.count < 2) {
      name_all([&](DartId d, auto&& visit) { detail::walk_linear(links_, d, visit); });
    } else {
      name_all([&](DartId d, auto&& visit) { walk_breadth_first(d, visit); });
    }
    close_all_rows();
    if (log_ != nullptr) record_changed_rows();
    index_.rows_.swap(work_.new_rows_);
  }

 private:
  [[nodiscard]] Row& row(DartId d) { return index_.rows_[index(d)]; }
  [[nodiscard]] DartId& smallest(Row row) { return index_.smallest_[row]; }

  // --- few touched darts: rows whose orbit was met are marked until they are taken

  void list_known(const KnownOrbits& known) {
    std::uint32_t begin = 0;
    for (const std::uint32_t end : known.ends) {
      const std::uint32_t first = listed_;
      for (const DartId d : known.darts.subspan(begin, end - begin)) take(d);
      end_part(first);
      begin = end;
    }
  }

  void drop(DartId d) {
    if (log_ != nullptr) log_->record_row(d, row(d));
    open_row(row(d));
    row(d) = kNoRow;
    ++done_.visited_darts;
  }

  void open_row(Row row) {
    if (marked(smallest(row))) return;
    smallest(row) = mark(smallest(row));
    work_.open_.push_back(row);
  }

  /// Lists a dart of the part at hand.
  [[gnu::always_inline]] void take(DartId d) {
    if (listed_ == work_.darts_.size()) make_room();
    const Row old = row(d);
    row(d) = kWalked;
    if (d < least_) {
      least_ = d;
      least_at_ = listed_;
    }
    work_.darts_[listed_] = d;
    work_.old_rows_[listed_++] = old;
    if (old == last_old_) return;
    last_old_ = old;
    if (old != kNoRow) open_row(old);
  }

  void make_room() {
    constexpr std::size_t kFirst = 64;
    work_.darts_.resize(std::max(kFirst, 2 * work_.darts_.size()));
    work_.old_rows_.resize(work_.darts_.size());
  }

  void walk_part(DartId d) {
    const std::uint32_t begin = listed_;
    if (links_.count <= 2) {
      detail::walk_linear(
          links_, d, [&](DartId x) __attribute__((always_inline)) { take(x); });
    } else {
      take(d);
      for (std::uint32_t next = begin; next < listed_; ++next) {
        for (int k = 0; k < links_.count; ++k) {
          const DartId x = links_.alpha[k][index(work_.darts_[next])];
          if (row(x) != kWalked) take(x);
        }
      }
    }
    end_part(begin);
  }

  /// The listed darts from number `begin` on are an orbit; its smallest comes first for name_part.
  void end_part(std::uint32_t begin) {
    DartId* const darts = work_.darts_.data();
    std::swap(darts[begin], darts[least_at_]);
    std::swap(work_.old_rows_[begin], work_.old_rows_[least_at_]);
    least_ = kNoDart;
    work_.parts_.push_back({darts[begin], begin, listed_});
    done_.visited_darts += listed_ - begin;
  }

  void name_part(const RepairSpace::Part& part) {
    const Row former = work_.old_rows_[part.darts_begin];
    const Row name = take_row(former, part.smallest);
    others_.clear();
    Row* const rows = index_.rows_.data();
    for (std::uint32_t i = part.darts_begin; i < part.darts_end; ++i) {
      const Row old = work_.old_rows_[i];
      if (old != former) others_.add(old);
      if (log_ != nullptr && old != name) log_->record_row(work_.darts_[i], old);
      rows[index(work_.darts_[i])] = name;
    }
    publish(name, part.smallest, former);
  }

  void name_known(std::span<const DartId> darts, DartId least) {
    const Row former = row(least);
    const Row name = take_row(former, least);
    others_.clear();
    Row* const rows = index_.rows_.data();
    for (const DartId d : darts) {
      const Row old = rows[index(d)];
      if (old == name) continue;  // no other row: a new one has no darts
      rows[index(d)] = name;
      if (log_ != nullptr) log_->record_row(d, old);
      if (old != kNoRow && old != former) others_.add(old);
    }
    publish(name, least, former);
  }

  /// The row for an orbit whose smallest dart had the row `former`.
  Row take_row(Row former, DartId least) {
    const bool free = former != kNoRow && marked(smallest(former));
    const Row name = free ? former : new_row();
    if (log_ != nullptr && free && unmark(smallest(name)) != least) {
      log_->record_smallest(name, unmark(smallest(name)));
    }
    smallest(name) = least;
    return name;
  }

  void sort_parts() {
    const auto before = [](const auto& a, const auto& b) { return a.smallest < b.smallest; };
    if (std::is_sorted(work_.parts_.begin(), work_.parts_.end(), before)) return;
    std::sort(work_.parts_.begin(), work_.parts_.end(), before);
  }

  void close_rows() {
    for (const Row row : work_.open_) {
      if (!marked(smallest(row))) continue;
      if (log_ != nullptr) log_->record_smallest(row, unmark(smallest(row)));
      remove_row(row);
    }
  }

  // --- many touched darts: rows are marked when they are taken

  void mark_touched(std::span<const DartId> darts) {
    const std::uint32_t dart_end = map_.dart_end();
    for (Row* const new_rows = work_.new_rows_.data(); DartId d : darts) {
      GMSIM_CHECK(index(d) < dart_end, "touched dart is not of this map");
      new_rows[index(d)] = kTouched;
    }
  }

  /// Goes through the map; `walk` calls its second argument for every dart of an orbit.
  template <class Walk>
  void name_all(Walk&& walk) {
    const Row* const old_rows = index_.rows_.data();
    Row* const new_rows = work_.new_rows_.data();
    const DartId* const alive = map_.alphas(0).data();
    const std::uint32_t dart_end = map_.dart_end();
    for (std::uint32_t i = 0; i < dart_end; ++i) {
      if (new_rows[i] < kTouched) continue;
      if (alive[i] == kNoDart) {
        new_rows[i] = kNoRow;
        continue;
      }
      const DartId d{i};
      const Row former = old_rows[i];
      const Row name = former != kNoRow && !marked(smallest(former)) ? former : new_row();
      Row marks = kNoRow;
      others_.clear();
      walk(
          d, [&](DartId x) __attribute__((always_inline)) {
            const Row old = old_rows[index(x)];
            marks &= new_rows[index(x)];
            new_rows[index(x)] = name;
            if (old != former) others_.add(old);
          });
      if (log_ != nullptr && smallest(name) != d) {
        log_->record_smallest(name, smallest(name));
      }
      smallest(name) = mark(d);
      if (marks != kNoRow) publish(name, d, former);
    }
    done_.visited_darts += dart_end;
  }

  template <class Visit>
  void walk_breadth_first(DartId d, Visit&& visit) {
    work_.queue_.assign(1, d);
    visit(d);
    const Row name = work_.new_rows_[index(d)];
    for (std::size_t next = 0; next < work_.queue_.size(); ++next) {
      for (int k = 0; k < links_.count; ++k) {
        const DartId x = links_.alpha[k][index(work_.queue_[next])];
        if (work_.new_rows_[index(x)] == name) continue;
        work_.queue_.push_back(x);
        visit(x);
      }
    }
  }

  void close_all_rows() {
    for (Row row = 0; row < index_.row_end(); ++row) {
      DartId& d = smallest(row);
      if (d == kNoDart) continue;
      if (marked(d)) {
        d = unmark(d);
      } else {
        if (log_ != nullptr) log_->record_smallest(row, d);
        remove_row(row);
      }
    }
  }

  void record_changed_rows() {
    for (std::uint32_t i = 0; i < map_.dart_end(); ++i) {
      const Row old = index_.rows_[i];
      if (old != work_.new_rows_[i]) log_->record_row(DartId{i}, old);
    }
  }

  // --- both

  Row new_row() {
    index_.smallest_.push_back(kNoDart);
    ++index_.alive_;
    return index_.row_end() - 1;
  }

  void remove_row(Row row) {
    smallest(row) = kNoDart;
    done_.removed.push_back(row);
    --index_.alive_;
  }

  /// Tells the caller of an orbit whose former rows are `former` and `others_`.
  void publish(Row row, DartId least, Row former) {
    const auto begin = static_cast<std::uint32_t>(done_.sources.size());
    if (!others_.empty()) {
      others_.write(former, done_.sources);
    } else if (former != kNoRow) {
      done_.sources.push_back(former);
    }
    const auto count = static_cast<std::uint32_t>(done_.sources.size()) - begin;
    done_.orbits.push_back({row, least, begin, count});
    if (count != 1) ++(count == 0 ? done_.created : done_.merged);
    done_.split += row != former && count > 0;
  }

  OrbitIndex& index_;
  const GMap& map_;
  OrbitRepair& done_;
  RepairSpace& work_;
  Journal::IndexLog* log_;  // null: nothing is recorded
  detail::OrbitLinks links_;
  OtherRows others_;
  std::uint32_t listed_ = 0;  // darts of all parts
  Row last_old_ = kNoRow;     // of the dart listed last
  DartId least_ = kNoDart;    // of the part at hand,
  std::uint32_t least_at_ = 0;  // and its place
};

void OrbitRepair::clear() {
  orbits.clear();
  sources.clear();
  removed.clear();
  created = split = merged = 0;
  visited_darts = 0;
}

void OrbitIndex::repair(const GMap& map, std::span<const DartId> touched,
                        const KnownOrbits& known, OrbitRepair& repair, RepairSpace& space,
                        Journal* journal) {
  if (touched.empty() && known.darts.empty()) return;
  OrbitRepairer repairer(*this, map, repair, space, journal);
  if (touched.size() + known.darts.size() < map.dart_end() / kManyTouched) {
    return touched.empty() ? repairer.repair_known(known) : repairer.repair_few(touched, known);
  }
  repairer.repair_many(touched, known.darts);
}

}  // namespace gmsim::gmap
