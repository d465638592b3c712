// SPDX-License-Identifier: MIT
#include "engine/effects.h"

#include <algorithm>

namespace gmsim::engine {

namespace {

template <typename Events>
auto* find_type(Events& events, OrbitType type) {
  const auto found = std::find_if(events.begin(), events.end(),
                                  [&](const OrbitEvents& entry) { return entry.type == type; });
  return found == events.end() ? nullptr : &*found;
}

void append_repair(gmap::OrbitRepair& all, const gmap::OrbitRepair& later) {
  const auto offset = static_cast<std::uint32_t>(all.sources.size());
  for (gmap::OrbitChange change : later.orbits) {
    change.sources_begin += offset;
    all.orbits.push_back(change);
  }
  all.sources.insert(all.sources.end(), later.sources.begin(), later.sources.end());
  all.removed.insert(all.removed.end(), later.removed.begin(), later.removed.end());
  all.created += later.created;
  all.split += later.split;
  all.merged += later.merged;
  all.visited_darts += later.visited_darts;
}

}  // namespace

gmap::OrbitRepair& Effects::repair(OrbitType type) {
  if (OrbitEvents* events = find_type(orbits, type)) return events->repair;
  return orbits.emplace_back(OrbitEvents{type, {}}).repair;
}

const gmap::OrbitRepair* Effects::find(OrbitType type) const {
  const OrbitEvents* events = find_type(orbits, type);
  return events == nullptr ? nullptr : &events->repair;
}

std::uint64_t Effects::visited_darts() const {
  std::uint64_t count = 0;
  for (const OrbitEvents& events : orbits) count += events.repair.visited_darts;
  return count;
}

void Effects::append(const Effects& later) {
  touched.insert(touched.end(), later.touched.begin(), later.touched.end());
  changed_links = OrbitType::from_bits(changed_links.bits() | later.changed_links.bits());
  written.insert(written.end(), later.written.begin(), later.written.end());
  for (std::size_t k = 0; k < later.orbits.size(); ++k) {
    const OrbitEvents& events = later.orbits[k];
    if (events.repair.visited_darts == 0 && events.repair.removed.empty()) continue;
    const bool same_place = k < orbits.size() && orbits[k].type == events.type;
    append_repair(same_place ? orbits[k].repair : repair(events.type), events.repair);
  }
  applications += later.applications;
  dropped += later.dropped;
  created_darts += later.created_darts;
  removed_darts += later.removed_darts;
  matched_rows += later.matched_rows;
  written_values += later.written_values;
}

void Effects::clear() {
  touched.clear();
  changed_links = {};
  written.clear();
  for (OrbitEvents& events : orbits) events.repair.clear();
  applications = dropped = created_darts = removed_darts = matched_rows = written_values = 0;
}

}  // namespace gmsim::engine
