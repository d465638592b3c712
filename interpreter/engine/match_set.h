// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/force_matches.h"
#include "engine/match_table.h"
#include "engine/match_watch.h"

namespace gmsim::engine {

/// The matches of one item: a table for each shape, found by key, and repaired one by one.
class MatchSet {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;
  struct Place {
    std::uint32_t shape = kNowhere;
    std::uint32_t row = 0;
  };
  static constexpr std::uint32_t kNowhere = 0xffffffffu;

  /// Everything given must outlive this.
  MatchSet(const ForceContext& context, const compile::RootedPattern& pattern,
           const compile::World& world, const compile::ItemBody& body, compile::Wanted wanted,
           const compile::ValueSources& sources);
  MatchSet(const MatchSet&) = delete;
  MatchSet& operator=(const MatchSet&) = delete;

  /// Finds all matches anew.
  Diagnostic rebuild();

  [[nodiscard]] std::size_t shape_count() const { return tables_.size(); }
  [[nodiscard]] const MatchTable& table(std::size_t shape) const { return *tables_[shape]; }
  [[nodiscard]] const compile::Shape& shape(std::size_t number) const {
    return finder_.shapes()[number];
  }
  [[nodiscard]] const ShapeInputs& inputs(std::uint32_t shape) const {
    return finder_.inputs(shape);
  }
  [[nodiscard]] std::uint32_t match_count() const;
  /// Where the match of the orbit with this smallest dart is.
  [[nodiscard]] Place place(DartId key) const {
    return types::index(key) < places_.size() ? places_[types::index(key)] : Place{};
  }
  /// visit(shape, row) for all matches, ascending by key.
  template <typename Visit>
  void in_order(const Visit& visit) const {
    for (const Place& place : places_)
      if (place.shape != kNowhere) visit(place.shape, place.row);
  }

  // Repairing single matches after a change of the map.

  /// False: only rebuild() is safe.
  [[nodiscard]] bool repairable() const { return watch_.complete() && own_stay_; }
  /// What rests on a change.
  struct Stale {
    std::vector<StaleMatch> matches;  ///< to look at again, ascending
    std::vector<DartId> hooks;        ///< darts at which matches may start that did not before
    std::vector<DartId> parts;        ///< darts of orbits that may be new
  };
  void find_stale(std::span<const compile::Dependence> changed, Stale& out);
  /// What a match that keeps its shape reads now.
  struct Reading {
    bool again = false;  ///< it has to be found again: nothing else is known
    struct Moved {
      std::uint32_t role = 0;
      Row from = 0, to = 0;
    };
    std::vector<Moved> moved;    ///< roles with another row
    bool own_changed = false;
    std::vector<double> own;     ///< its own numbers, when they had to be looked at
  };
  /// Looks at a match that rests on what has changed; changes nothing.
  Diagnostic read_again(Place place, compile::Aspects what, Reading& out);
  void adopt(Place place, const Reading& reading);
  /// Takes a match out and appends the darts from which one may be found in its place.
  void remove(DartId key, std::vector<DartId>& hooks);
  /// When all stale matches have been looked at: makes `hooks` the smallest darts of the orbits in
  /// which matches have to be found, each once.
  void list_orbits(Stale& stale) const;
  /// Finds and adds the match of an orbit that has none in the tables; empty when there is none.
  Diagnostic find_at(DartId dart, std::optional<DartId>& key);
  /// Are many rows vacant?
  [[nodiscard]] bool crowded() const;
  /// Brings the matches of all tables into the order of their keys, without vacant rows.
  void pack();

 private:
  void to_orbits(std::vector<DartId>& darts) const;
  void add(const ForceMatch& match);
  void add_shape(const ForceMatch& first);

  const ForceContext& context_;
  const compile::ItemBody& body_;
  ForceMatches finder_;
  std::vector<std::unique_ptr<MatchTable>> tables_;  // by shape
  std::vector<Place> places_;                        // by key
  MatchWatch watch_;
  bool own_stay_ = true;  // what matches know themselves changes with the darts they rest on alone
  std::vector<compile::Role> roles_;  // work space
};

}  // namespace gmsim::engine
