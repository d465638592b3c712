// SPDX-License-Identifier: MIT
// The jobs of bench_map with CGAL's Generalized_map and a vertex attribute that holds the position.
#include "bench/bench_map_cgal.h"

#include <CGAL/Cell_attribute.h>
#include <CGAL/Generalized_map.h>

#include <map>
#include <utility>
#include <vector>

#include "bench/bench_timing.h"

namespace gmsim::bench {

namespace {

using Point = std::array<double, 3>;

struct Mean {
  template <class Attribute>
  void operator()(Attribute& kept, const Attribute& gone) const {
    for (std::size_t k = 0; k < 3; ++k) {
      kept.info()[k] = 0.5 * (kept.info()[k] + gone.info()[k]);
    }
  }
};

template <class OnMerge>
struct Items {
  template <class Map>
  struct Dart_wrapper {
    using Vertex = CGAL::Cell_attribute<Map, Point, CGAL::Tag_true, OnMerge>;
    using Attributes = std::tuple<Vertex>;
  };
};

template <class OnMerge>
class CgalJobs {
 public:
  using Map = CGAL::Generalized_map<2, Items<OnMerge>>;
  using Dart = typename Map::Dart_handle;

  explicit CgalJobs(const gmap::Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Dart> open;  // point pair -> unsewn edge
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
      const auto corners = mesh.corners(cell);
      Dart d = map_.make_combinatorial_polygon(static_cast<unsigned>(corners.size()));
      for (std::size_t c = 0; c < corners.size(); ++c, d = map_.template alpha<0, 1>(d)) {
        add_edge(mesh, d, corners[c], corners[(c + 1) % corners.size()], open);
      }
    }
  }

  [[nodiscard]] std::size_t darts() const { return map_.number_of_darts(); }
  [[nodiscard]] double bytes() const { return static_cast<double>(map_.bytes()); }

  std::size_t walk() {
    std::size_t count = 0;
    for (auto v = map_.template attributes<0>().begin(); v != map_.template attributes<0>().end();
         ++v) {
      for (auto d = map_.template darts_of_orbit<1, 2>(v->dart()).begin(); d.cont(); ++d) ++count;
    }
    return count;
  }
  std::vector<std::pair<Dart, Dart>> unsew_all() {
    std::vector<std::pair<Dart, Dart>> edges;
    for (auto d = map_.darts().begin(); d != map_.darts().end(); ++d) {
      if (map_.template is_free<2>(d)) continue;
      edges.emplace_back(d, map_.template alpha<2>(d));
      map_.template unsew<2>(d);
    }
    return edges;
  }
  void sew_all(const std::vector<std::pair<Dart, Dart>>& edges) {
    for (auto [d, e] : edges) map_.template sew<2>(d, e);
  }
  void cone_all() {
    for (Dart d : one_dart_per_face()) {
      Point middle{};
      double count = 0;
      for (auto x = map_.template darts_of_orbit<0, 1>(d).begin(); x.cont(); ++x, ++count) {
        for (std::size_t k = 0; k < 3; ++k) middle[k] += map_.template info<0>(x)[k];
      }
      for (double& x : middle) x /= count;
      const Dart centre = map_.insert_cell_0_in_cell_2(d);
      map_.template set_attribute<0>(centre, map_.template create_attribute<0>(middle));
    }
  }
  void remove_every_second() {
    const std::vector<Dart> faces = one_dart_per_face();
    for (std::size_t k = 1; k < faces.size(); k += 2) map_.template remove_cell<2>(faces[k]);
  }

 private:
  using Open = std::map<std::pair<std::uint32_t, std::uint32_t>, Dart>;

  void add_edge(const gmap::Mesh& mesh, Dart d, std::uint32_t a, std::uint32_t b, Open& open) {
    if (map_.template attribute<0>(d) == nullptr) {
      map_.template set_attribute<0>(d, map_.template create_attribute<0>(mesh.points[a]));
    }
    const Dart end = map_.template alpha<0>(d);
    if (map_.template attribute<0>(end) == nullptr) {
      map_.template set_attribute<0>(end, map_.template create_attribute<0>(mesh.points[b]));
    }
    const auto beside = open.find({b, a});
    if (beside == open.end()) {
      open.emplace(std::pair{a, b}, d);
    } else {
      map_.template sew<2>(d, map_.template alpha<0>(beside->second));
      open.erase(beside);
    }
  }
  std::vector<Dart> one_dart_per_face() {
    std::vector<Dart> faces;
    auto range = map_.template one_dart_per_cell<2>();
    for (auto d = range.begin(); d != range.end(); ++d) faces.push_back(d);
    return faces;
  }

  Map map_;
};

}  // namespace

CgalTimes measure_cgal(const gmap::Mesh& mesh, int repetitions) {
  std::array<std::vector<double>, 7> times;
  CgalTimes result;
  double darts = 1.0;
  const auto add = [&](std::size_t job, auto&& work) { times[job].push_back(seconds(work)); };
  for (int k = 0; k < repetitions; ++k) {
    add(0, [&] { keep(CgalJobs<Mean>(mesh)); });
    CgalJobs<Mean> mean(mesh);
    CgalJobs<CGAL::Null_functor> first(mesh), cone(mesh), removal(mesh);
    darts = static_cast<double>(mean.darts());
    result.bytes_per_dart = mean.bytes() / darts;
    add(1, [&] { keep(mean.walk()); });
    decltype(mean.unsew_all()) edges;
    add(2, [&] { edges = mean.unsew_all(); });
    add(3, [&] { mean.sew_all(edges); });
    const auto first_edges = first.unsew_all();
    add(4, [&] { first.sew_all(first_edges); });
    add(5, [&] { cone.cone_all(); });
    add(6, [&] { removal.remove_every_second(); });
  }
  result.measured = true;
  for (std::size_t job = 0; job < times.size(); ++job) {
    result.ns_per_dart[job] = 1e9 * median(times[job]) / darts;
  }
  return result;
}

}  // namespace gmsim::bench
