// SPDX-License-Identifier: MIT
#include "gmap/validate.h"

#include <fmt/format.h>

#include "gmap/orbit_walk.h"

namespace gmsim::gmap {

namespace {

/// Collects problems up to a limit.
class Problems {
 public:
  explicit Problems(std::size_t limit) : limit_(limit) {}
  [[nodiscard]] bool full() const { return found_.size() >= limit_; }
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    if (!full()) found_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(found_); }

 private:
  std::size_t limit_;
  std::vector<std::string> found_;
};

bool check_link(const GMap& map, int i, DartId d, Problems& problems) {
  const DartId other = map.alpha(i, d);
  if (!map.alive(other)) {
    problems.add("dart {}: its {}-link leads to dart {}, which is not alive", index(d), i,
                 index(other));
    return false;
  }
  if (map.alpha(i, other) != d) {
    problems.add("dart {}: its {}-link leads to dart {}, whose {}-link leads to dart {}", index(d),
                 i, index(other), i, index(map.alpha(i, other)));
    return false;
  }
  return true;
}

void check_cycle(const GMap& map, int i, int j, DartId d, Problems& problems) {
  const DartId ij = map.alpha(j, map.alpha(i, d)), ji = map.alpha(i, map.alpha(j, d));
  if (ij == ji) return;
  problems.add("dart {}: @{}@{} is dart {} but @{}@{} is dart {}", index(d), i, j, index(ij), j, i,
               index(ji));
}

void check_map(const GMap& map, Problems& problems) {
  bool sound = true;
  std::uint32_t alive = 0;
  for (std::uint32_t d = 0; d < map.dart_end() && !problems.full(); ++d) {
    if (!map.alive(DartId{d})) continue;
    ++alive;
    for (int i = 0; i <= map.dimension(); ++i) sound &= check_link(map, i, DartId{d}, problems);
  }
  if (problems.full()) return;
  if (alive != map.dart_count()) {
    problems.add("{} darts are alive but the map counts {}", alive, map.dart_count());
  }
  if (!sound) return;  // the walks below need links that lead somewhere
  for (std::uint32_t d = 0; d < map.dart_end() && !problems.full(); ++d) {
    if (!map.alive(DartId{d})) continue;
    for (int i = 0; i <= map.dimension(); ++i) {
      for (int j = i + 2; j <= map.dimension(); ++j) check_cycle(map, i, j, DartId{d}, problems);
    }
  }
}

/// The rows agree with a walk from each smallest dart: the walks cover every alive dart once.
void check_index(const GMap& map, const OrbitIndex& orbits, Problems& problems) {
  const std::string type = to_string(orbits.type());
  if (orbits.rows().size() != map.dart_end()) {
    problems.add("index {}: {} darts, but the map has {}", type, orbits.rows().size(),
                 map.dart_end());
    return;
  }
  for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
    if (map.alive(DartId{d}) || orbits.row(DartId{d}) == kNoRow) continue;
    problems.add("index {}: dart {} is not alive but has row {}", type, d, orbits.row(DartId{d}));
  }
  Row alive = 0;
  std::uint32_t covered = 0;
  for (Row row = 0; row < orbits.row_end() && !problems.full(); ++row) {
    if (!orbits.alive(row)) continue;
    ++alive;
    const DartId smallest = orbits.smallest(row);
    if (!map.alive(smallest)) {
      problems.add("index {}: row {} has dart {}, which is not alive", type, row, index(smallest));
      continue;
    }
    for_each_dart(map, orbits.type(), smallest, [&](DartId d) {
      ++covered;
      if (d < smallest) {
        problems.add("index {}: row {} has smallest dart {}, but its orbit has dart {}", type, row,
                     index(smallest), index(d));
      }
      if (orbits.row(d) != row) {
        problems.add("index {}: dart {} is in the orbit of row {} but has row {}", type, index(d),
                     row, static_cast<std::int64_t>(orbits.row(d)));
      }
    });
  }
  if (problems.full()) return;
  if (alive != orbits.orbit_count()) {
    problems.add("index {}: {} rows are alive but it counts {}", type, alive, orbits.orbit_count());
  }
  if (covered != map.dart_count()) {
    problems.add("index {}: its orbits hold {} darts, but the map has {}", type, covered,
                 map.dart_count());
  }
}

void check_column(const EmbeddingStore& store, types::EmbeddingId id, Problems& problems) {
  const EmbeddingDecl& decl = store.schema()[id];
  const EmbeddingColumn& column = store.column(id);
  const OrbitIndex& orbits = store.index_of(id);
  if (column.row_end() != orbits.row_end()) {
    problems.add("`{}`: {} rows, but its index {} has {}", decl.name, column.row_end(),
                 to_string(decl.orbit), orbits.row_end());
    return;
  }
  for (Row row = 0; row < orbits.row_end() && !problems.full(); ++row) {
    if (decl.optional || !orbits.alive(row) || column.has(row)) continue;
    problems.add("`{}`: no value for the orbit {} of dart {}", decl.name, to_string(decl.orbit),
                 index(orbits.smallest(row)));
  }
}

}  // namespace

std::vector<std::string> validate(const GMap& map, std::size_t limit) {
  Problems problems(limit);
  check_map(map, problems);
  return problems.take();
}

std::vector<std::string> validate(const GMap& map, const EmbeddingStore& store, std::size_t limit) {
  std::vector<std::string> broken = validate(map, limit);
  if (!broken.empty()) return broken;
  Problems problems(limit);
  for (const auto& orbits : store.indices()) check_index(map, *orbits, problems);
  for (types::EmbeddingId id : store.embeddings()) check_column(store, id, problems);
  return problems.take();
}

}  // namespace gmsim::gmap
