// SPDX-License-Identifier: MIT
#include "bench/bare_map.h"

namespace gmsim::bench {

namespace {

using Int = std::int32_t;

void link(std::vector<Int>& alpha, Int a, Int b) {
  alpha[a] = b;
  alpha[b] = a;
}

/// For each point a list of the edges still without a neighbour that start there.
struct OpenEdges {
  std::vector<Int> first;  // per point
  std::vector<Int> next;   // per edge (dart / 2)
};

void sew_edge(BareMap& map, OpenEdges& open, Int dart) {
  const Int a = map.vertex[dart], b = map.vertex[dart + 1];
  const Int low = std::min(a, b), high = std::max(a, b);
  Int* place = &open.first[low];
  while (*place >= 0) {
    const Int edge = 2 * *place;
    if (map.vertex[edge] == high || map.vertex[edge + 1] == high) {
      const Int beside = map.vertex[edge] == a ? edge : edge + 1;
      link(map.alpha2, dart, beside);
      link(map.alpha2, dart + 1, beside ^ 1);
      *place = open.next[*place];
      return;
    }
    place = &open.next[*place];
  }
  *place = dart / 2;
}

/// After unsewing d and e at one of their ends: gives the part with e a vertex of its own.
void split_vertex(BareMap& map, Int d, Int e) {
  Int x = e;
  while (true) {
    const Int y = map.alpha1[x];
    if (y == d) return;  // still connected the other way round
    x = map.alpha2[y];
    if (x == y) break;
  }
  const auto added = static_cast<Int>(map.position.size());
  map.position.push_back(map.position[map.vertex[d]]);
  x = e;
  while (true) {
    map.vertex[x] = added;
    const Int y = map.alpha1[x];
    map.vertex[y] = added;
    x = map.alpha2[y];
    if (x == y) return;
  }
}

/// Before sewing d and e: the part that starts with e gets the vertex of d. Returns its old vertex,
/// or that of d when there is nothing to do.
Int merge_vertex(BareMap& map, Int d, Int e) {
  const Int kept = map.vertex[d], gone = map.vertex[e];
  if (gone == kept) return kept;
  Int x = e;
  while (true) {
    map.vertex[x] = kept;
    const Int y = map.alpha1[x];
    map.vertex[y] = kept;
    x = map.alpha2[y];
    if (x == y) return gone;
  }
}

/// Adds the position of a merged vertex to the sum that the other one holds.
void add_position(BareMap& map, std::vector<Int>& count, Int kept, Int gone) {
  if (kept == gone) return;
  count[kept] += count[gone];
  for (int k = 0; k < 3; ++k) map.position[kept][k] += map.position[gone][k];
}

/// The darts round a face: alpha0 links the first to the second, alpha1 the second to the third …
void face_darts(const BareMap& map, Int d, std::vector<Int>& darts) {
  darts.clear();
  Int x = d;
  do {
    darts.push_back(x);
    darts.push_back(map.alpha0[x]);
    x = map.alpha1[map.alpha0[x]];
  } while (x != d);
}

void cone_face(BareMap& map, const std::vector<Int>& face, Int first_new) {
  const auto count = static_cast<Int>(face.size());
  const auto middle = static_cast<Int>(map.position.size());
  std::array<double, 3> sum{};
  for (Int i = 0; i < count; ++i) {
    const Int a = face[i], b = first_new + 2 * i, c = b + 1;
    const Int by0 = i ^ 1,
              by1 = i % 2 == 1 ? (i + 1 == count ? 0 : i + 1) : (i == 0 ? count - 1 : i - 1);
    link(map.alpha1, a, b);
    link(map.alpha0, b, c);
    map.alpha2[b] = first_new + 2 * by1;
    map.alpha1[c] = first_new + 2 * by0 + 1;
    map.alpha2[c] = first_new + 2 * by1 + 1;
    map.vertex[b] = map.vertex[a];
    map.vertex[c] = middle;
    for (int k = 0; k < 3; ++k) sum[k] += map.position[map.vertex[a]][k];
  }
  for (int k = 0; k < 3; ++k) sum[k] /= count;
  map.position.push_back(sum);
}

void remove_face(BareMap& map, const std::vector<Int>& face, std::vector<Int>& loose) {
  for (Int x : face) {
    const Int e = map.alpha2[x];
    map.alpha0[x] = -1;
    if (e == x) continue;
    map.alpha2[e] = e;
    loose.push_back(e);
  }
}

/// Gives each part of a vertex but the first one met a vertex of its own. A part is an open chain;
/// it is handled from the end that comes first in `loose`.
void split_parts(BareMap& map, const std::vector<Int>& loose) {
  std::vector<bool> kept(map.position.size(), false), done(map.alpha0.size(), false);
  for (Int e : loose) {
    if (map.alpha0[e] < 0 || done[e]) continue;
    Int number = map.vertex[e];
    if (kept[number]) {
      map.position.push_back(map.position[number]);
      number = static_cast<Int>(map.position.size()) - 1;
      kept.push_back(true);
    }
    kept[number] = true;
    Int x = e, y = map.alpha1[x];
    map.vertex[x] = map.vertex[y] = number;
    while (map.alpha2[y] != y) {
      x = map.alpha2[y];
      y = map.alpha1[x];
      map.vertex[x] = map.vertex[y] = number;
    }
    done[y] = true;
  }
}

}  // namespace

std::size_t BareMap::memory_bytes() const {
  return (alpha0.capacity() + alpha1.capacity() + alpha2.capacity() + vertex.capacity()) *
             sizeof(Int) +
         position.capacity() * sizeof(position[0]);
}

BareMap bare_construct(const gmap::Mesh& mesh) {
  const std::size_t darts = 2 * mesh.cell_points.size();
  BareMap map{std::vector<Int>(darts), std::vector<Int>(darts), std::vector<Int>(darts),
              std::vector<Int>(darts), mesh.points};
  OpenEdges open{std::vector<Int>(mesh.points.size(), -1), std::vector<Int>(darts / 2, -1)};
  Int d = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto corners = mesh.corners(cell);
    const Int first = d, last = d + 2 * static_cast<Int>(corners.size()) - 1;
    for (std::size_t c = 0; c < corners.size(); ++c, d += 2) {
      link(map.alpha0, d, d + 1);
      map.alpha1[d] = d == first ? last : d - 1;
      map.alpha1[d + 1] = d + 1 == last ? first : d + 2;
      map.alpha2[d] = d;
      map.alpha2[d + 1] = d + 1;
      map.vertex[d] = static_cast<Int>(corners[c]);
      map.vertex[d + 1] = static_cast<Int>(corners[d + 1 == last ? 0 : c + 1]);
      sew_edge(map, open, d);
    }
  }
  return map;
}

std::vector<Int> bare_vertex_darts(const BareMap& map) {
  std::vector<Int> darts(map.position.size(), -1);
  for (Int d = map.dart_end(); d-- > 0;) darts[map.vertex[d]] = d;
  return darts;
}

std::int64_t bare_walk(const BareMap& map, const std::vector<Int>& starts) {
  std::int64_t sum = 0;
  for (Int d : starts) {
    Int x = d;
    bool closed = false;
    while (true) {
      sum += x;
      const Int y = map.alpha1[x];
      sum += y;
      x = map.alpha2[y];
      closed = x == d;
      if (closed || x == y) break;
    }
    if (closed) continue;
    x = map.alpha2[d];
    for (Int y = d; x != y; x = map.alpha2[y]) {
      y = map.alpha1[x];
      sum += x + y;
    }
  }
  return sum;
}

Int bare_number_vertices(BareMap& map) {
  map.vertex.assign(map.vertex.size(), -1);
  Int count = 0;
  for (Int d = 0; d < map.dart_end(); ++d) {
    if (map.vertex[d] >= 0) continue;
    Int x = d;
    bool closed = false;
    while (true) {
      map.vertex[x] = count;
      const Int y = map.alpha1[x];
      map.vertex[y] = count;
      x = map.alpha2[y];
      closed = x == d;
      if (closed || x == y) break;
    }
    if (!closed) {
      x = map.alpha2[d];
      for (Int y = d; x != y; x = map.alpha2[y]) {
        y = map.alpha1[x];
        map.vertex[x] = map.vertex[y] = count;
      }
    }
    ++count;
  }
  return count;
}

SewnEdges bare_unsew_all(BareMap& map) {
  SewnEdges edges;
  for (Int d = 0; d < map.dart_end(); ++d) {
    const Int e = map.alpha2[d], d0 = map.alpha0[d];
    if (e <= d || d0 < d) continue;
    const Int e0 = map.alpha0[e];
    edges.emplace_back(d, e);
    for (Int x : {d, e, d0, e0}) map.alpha2[x] = x;
    split_vertex(map, d, e);
    split_vertex(map, d0, e0);
  }
  return edges;
}

void bare_displace(BareMap& map) {
  const std::vector<Int> smallest = bare_vertex_darts(map);
  for (std::size_t v = 0; v < smallest.size(); ++v) {
    map.position[v][2] += displacement(static_cast<std::uint32_t>(smallest[v]));
  }
}

void bare_sew_all(BareMap& map, const SewnEdges& edges, Merge merge) {
  std::vector<Int> count(merge == Merge::Mean ? map.position.size() : 0, 1);
  for (auto [d, e] : edges) {
    const Int d0 = map.alpha0[d], e0 = map.alpha0[e];
    const Int gone = merge_vertex(map, d, e), gone0 = merge_vertex(map, d0, e0);
    if (merge == Merge::Mean) {
      add_position(map, count, map.vertex[d], gone);
      add_position(map, count, map.vertex[d0], gone0);
    }
    link(map.alpha2, d, e);
    link(map.alpha2, d0, e0);
  }
  for (std::size_t v = 0; v < count.size(); ++v) {
    if (count[v] == 1) continue;
    for (double& x : map.position[v]) x /= count[v];
  }
}

void bare_cone_all(BareMap& map) {
  const Int old_end = map.dart_end();
  for (auto* array : {&map.alpha0, &map.alpha1, &map.alpha2, &map.vertex}) {
    array->resize(3 * static_cast<std::size_t>(old_end));
  }
  std::vector<Int> face;
  std::vector<bool> done(static_cast<std::size_t>(old_end), false);
  Int first_new = old_end;
  for (Int d = 0; d < old_end; ++d) {
    if (done[d]) continue;
    face_darts(map, d, face);
    for (Int x : face) done[x] = true;
    cone_face(map, face, first_new);
    first_new += 2 * static_cast<Int>(face.size());
  }
}

void bare_remove_every_second(BareMap& map) {
  std::vector<Int> face, loose;
  std::vector<bool> done(map.alpha0.size(), false);
  Int number = 0;
  for (Int d = 0; d < map.dart_end(); ++d) {
    if (done[d]) continue;
    face_darts(map, d, face);
    for (Int x : face) done[x] = true;
    if (number++ % 2 == 1) remove_face(map, face, loose);
  }
  split_parts(map, loose);
}

}  // namespace gmsim::bench
