// SPDX-License-Identifier: MIT
#include "bench/map_jobs.h"

#include "gmap/orbit_walk.h"

namespace gmsim::bench {

using gmap::DartId;
using gmap::OrbitType;
using gmap::Row;
using types::index;

namespace {

const OrbitType kVertex{1, 2}, kFace{0, 1};

gmap::EmbeddingDecl position_decl() {
  gmap::EmbeddingDecl decl;
  decl.name = "position";
  decl.type = {types::ValueKind::Vec3};
  decl.orbit = kVertex;
  return decl;
}

}  // namespace

MapJobs::MapJobs(gmap::MeshMap built, const std::vector<std::array<double, 3>>& points,
                 Workspace& work)
    : map_(std::move(built.map)),
      position_(schema_.add(position_decl())),
      store_(schema_, map_),
      vertices_(store_.use_index(kVertex)),
      faces_(store_.use_index(kFace)),
      positions_(store_.use(position_)),
      work_(work) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (built.point_dart[p] != gmap::kNoDart) {
      positions_.set(vertices_.row(built.point_dart[p]), points[p]);
    }
  }
}

std::int64_t MapJobs::walk_vertices() const {
  std::int64_t sum = 0;
  for (Row row = 0; row < vertices_.row_end(); ++row) {
    gmap::for_each_dart(map_, kVertex, vertices_.smallest(row), [&](DartId d) { sum += index(d); });
  }
  return sum;
}

void MapJobs::repair_vertices() {
  work_.vertices.clear();
  vertices_.repair(map_, work_.touched, work_.vertices);
  positions_.resize(vertices_.row_end());
  for (const gmap::OrbitChange& change : work_.vertices.orbits) {
    if (change.sources_count == 0 || positions_.has(change.row)) continue;
    positions_.copy(work_.vertices.sources_of(change).front(), change.row);
  }
}

void MapJobs::repair_faces() {
  work_.faces.clear();
  faces_.repair(map_, work_.touched, work_.faces);
}

MapJobs::Edges MapJobs::unsew_all() {
  Edges edges;
  work_.touched.clear();
  for (std::uint32_t i = 0; i < map_.dart_end(); ++i) {
    const DartId d{i}, e = map_.alpha(2, d);
    if (e <= d || map_.alpha(0, d) < d) continue;
    edges.emplace_back(d, e);
    map_.unsew(2, d, &work_.touched);
  }
  repair_vertices();  // no 2-link is part of a face
  return edges;
}

void MapJobs::displace() {
  for (Row row = 0; row < vertices_.row_end(); ++row) {
    positions_.data()[3 * row + 2] += displacement(index(vertices_.smallest(row)));
  }
}

void MapJobs::sew_dart(DartId d, DartId e, Merge merge) {
  map_.link(2, d, e);
  const Row gone = vertices_.merge(map_, d, e);
  if (merge == Merge::Mean && gone != gmap::kNoRow) add_position(vertices_.row(d), gone);
}

void MapJobs::sew_all(const Edges& edges, Merge merge) {
  work_.sources.assign(merge == Merge::Mean ? vertices_.row_end() : 0, 1);
  for (auto [d, e] : edges) {
    sew_dart(d, e, merge);
    sew_dart(map_.alpha(0, d), map_.alpha(0, e), merge);
  }
  if (merge == Merge::Mean) divide_positions();
}

/// The kept row holds the sum over its sources until divide_positions.
void MapJobs::add_position(Row kept, Row gone) {
  const std::span<double> sum = positions_.data();
  for (std::size_t k = 0; k < 3; ++k) sum[3 * kept + k] += sum[3 * gone + k];
  work_.sources[kept] += work_.sources[gone];
}

void MapJobs::divide_positions() {
  const std::span<double> sum = positions_.data();
  for (Row row = 0; row < vertices_.row_end(); ++row) {
    if (work_.sources[row] == 1) continue;
    for (std::size_t k = 0; k < 3; ++k) sum[3 * row + k] /= work_.sources[row];
  }
}

std::array<double, 3> MapJobs::face_middle() const {
  std::array<double, 3> sum{};
  for (DartId d : work_.face) {
    const auto position = positions_.get(vertices_.row(d));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += position[k];
  }
  for (double& x : sum) x /= static_cast<double>(work_.face.size());
  return sum;
}

/// The rule a*:<0 1> => a:<0 _> b:<_ 2> c:<1 2> | a-1-b b-0-c on the darts of `face`. Of the new
/// darts, 2k is the b and 2k + 1 the c of the k-th dart a.
void MapJobs::cone_face(DartId first_new) {
  const auto count = static_cast<std::uint32_t>(work_.face.size());
  const auto new_dart = [&](std::uint32_t k) { return DartId{index(first_new) + k}; };
  DartId* const alpha0 = map_.new_links(0, first_new).data();
  DartId* const alpha1 = map_.new_links(1, first_new).data();
  DartId* const alpha2 = map_.new_links(2, first_new).data();
  const DartId* const face = work_.face.data();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t after = k + 1 == count ? 0 : k + 1, before = (k == 0 ? count : k) - 1;
    const std::uint32_t b = 2 * k, c = b + 1, by1 = 2 * (k % 2 == 0 ? before : after);
    map_.set_alpha(1, face[k], new_dart(b));
    alpha1[b] = face[k];
    alpha0[b] = new_dart(c);
    alpha0[c] = new_dart(b);
    alpha1[c] = new_dart(c ^ 2);
    alpha2[b] = new_dart(by1);
    alpha2[c] = new_dart(by1 + 1);
  }
}

/// The rule tells what becomes of the orbits: b joins the vertex of a, the darts c are a new
/// vertex, and every two darts of the old face have a face with their b and c.
void MapJobs::name_cone(Row face_row, std::uint32_t first_new) {
  const auto& face = work_.face;
  const DartId smallest = faces_.smallest(face_row);
  work_.middle.resize(face.size());
  for (std::uint32_t i = 0; i < face.size(); i += 2) {
    const std::uint32_t b = first_new + 2 * i;
    const std::array<DartId, 6> triangle{face[i],       face[i + 1],   DartId{b},
                                         DartId{b + 1}, DartId{b + 2}, DartId{b + 3}};
    vertices_.add_dart(DartId{b}, vertices_.row(face[i]));
    vertices_.add_dart(DartId{b + 2}, vertices_.row(face[i + 1]));
    work_.middle[i] = DartId{b + 1};
    work_.middle[i + 1] = DartId{b + 3};
    if (face[i] == smallest || face[i + 1] == smallest) {
      for (std::size_t k = 2; k < 6; ++k) faces_.add_dart(triangle[k], face_row);
    } else {
      faces_.add_orbit(triangle);
    }
  }
  vertices_.add_orbit(work_.middle);
}

void MapJobs::cone_all() {
  const Row face_end = faces_.row_end(), first_middle = vertices_.row_end();
  const std::uint32_t old_end = map_.dart_end();
  map_.reserve(3 * old_end);
  vertices_.reserve(3 * old_end, first_middle + face_end);
  faces_.reserve(3 * old_end, old_end / 2);
  positions_.resize(first_middle + face_end);
  for (Row row = 0; row < face_end; ++row) {
    work_.face.clear();
    gmap::for_each_dart(map_, kFace, faces_.smallest(row),
                        [&](DartId d) { work_.face.push_back(d); });
    positions_.set(first_middle + row, face_middle());
    const DartId first_new = map_.add_darts(2 * static_cast<std::uint32_t>(work_.face.size()));
    vertices_.grow(map_);
    faces_.grow(map_);
    cone_face(first_new);
    name_cone(row, index(first_new));
  }
}

void MapJobs::remove_every_second() {
  work_.touched.clear();
  auto& removed = work_.removed;
  removed.clear();
  for (Row row = 1; row < faces_.row_end(); row += 2) {
    const std::size_t begin = removed.size();
    gmap::for_each_dart(map_, kFace, faces_.smallest(row), [&](DartId d) { removed.push_back(d); });
    for (std::size_t i = begin; i < removed.size(); ++i) map_.unsew(2, removed[i], &work_.touched);
  }
  map_.remove_darts(removed);
  work_.touched.insert(work_.touched.end(), removed.begin(), removed.end());
  repair_vertices();
  repair_faces();
}

}  // namespace gmsim::bench
