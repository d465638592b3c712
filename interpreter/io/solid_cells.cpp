// SPDX-License-Identifier: MIT
#include "io/solid_cells.h"

#include <algorithm>
#include <map>

#include "gmap/orbit_walk.h"
#include "gmap/solid_shape.h"

namespace gmsim::io {

using gmap::DartId;
using gmap::GMap;
using Kind = gmap::Mesh::CellKind;

SolidRecognizer::SolidRecognizer() {
  for (Kind kind : {Kind::Tetrahedron, Kind::Hexahedron, Kind::Prism, Kind::Pyramid}) {
    references_.push_back(make_reference(kind));
  }
}

SolidRecognizer::Reference SolidRecognizer::make_reference(Kind kind) {
  const gmap::SolidDarts solid = gmap::solid_darts(kind);
  const std::size_t corners = 1u + *std::max_element(solid.corner.begin(), solid.corner.end());
  Reference reference{kind, corners, solid.corner, solid.alpha, {}};
  std::vector<bool> placed(solid.corner.size(), false);
  std::vector<std::uint8_t> queue = {0};
  placed[0] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (std::uint8_t link = 0; link < 3; ++link) {
      const std::uint8_t to = solid.alpha[link][queue[i]];
      if (placed[to]) continue;
      placed[to] = true;
      queue.push_back(to);
      reference.steps.push_back({queue[i], link, to});
    }
  }
  return reference;
}

bool SolidRecognizer::place(const Reference& reference, const GMap& map, DartId first,
                            std::vector<DartId>& images) {
  images.assign(reference.corner.size(), gmap::kNoDart);
  images[0] = first;
  for (const Step& step : reference.steps)
    images[step.to] = map.alpha(step.link, images[step.from]);
  for (int link = 0; link < 3; ++link) {
    for (std::size_t dart = 0; dart < images.size(); ++dart) {
      if (map.alpha(link, images[dart]) != images[reference.alpha[link][dart]]) return false;
    }
  }
  return true;
}

std::optional<SolidMatch> SolidRecognizer::match(const GMap& map,
                                                 std::span<const DartId> darts) const {
  std::vector<DartId> images;
  for (const Reference& reference : references_) {
    if (reference.corner.size() != darts.size()) continue;
    for (DartId first : darts) {
      if (!place(reference, map, first, images)) continue;
      // Equal links and equal counts: the images are the whole volume, unless two fell together.
      std::vector<DartId> sorted = images;
      std::sort(sorted.begin(), sorted.end());
      if (!std::equal(sorted.begin(), sorted.end(), darts.begin())) continue;
      SolidMatch match{reference.kind, std::vector<DartId>(reference.corner_count)};
      for (std::size_t dart = images.size(); dart-- > 0;) {
        match.corners[reference.corner[dart]] = images[dart];
      }
      return match;
    }
  }
  return std::nullopt;
}

namespace {

/// From the end of an open face to the other, one dart for each corner.
Face open_face_corners(const GMap& map, DartId d) {
  int link = 1;
  for (; !map.is_free(link, d); link = 1 - link) d = map.alpha(link, d);
  Face corners = {d};
  for (link = 1 - link; !map.is_free(link, d); link = 1 - link) {
    d = map.alpha(link, d);
    if (link == 0) corners.push_back(d);
  }
  return corners;
}

/// True for every second dart, so that neighbours differ; empty when that is impossible.
std::map<DartId, bool> two_sides(const GMap& map, std::span<const DartId> darts) {
  std::map<DartId, bool> side;
  std::vector<DartId> queue = {darts.front()};
  side[darts.front()] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int link = 0; link < 3; ++link) {
      const DartId next = map.alpha(link, queue[i]);
      if (next == queue[i]) continue;
      const auto [entry, is_new] = side.emplace(next, !side[queue[i]]);
      if (is_new) queue.push_back(next);
      if (!is_new && entry->second == side[queue[i]]) return {};
    }
  }
  return side;
}

}  // namespace

Face face_corners(const GMap& map, DartId d) {
  if (auto closed = gmap::polygon(map, d)) return *closed;
  return open_face_corners(map, d);
}

std::vector<Face> volume_faces(const GMap& map, std::span<const DartId> darts) {
  const auto side = two_sides(map, darts);
  std::vector<Face> faces;
  std::map<DartId, bool> seen;
  for (DartId d : darts) {
    if (seen[d] || (!side.empty() && !side.at(d))) continue;
    gmap::for_each_dart(map, gmap::OrbitType{0, 1}, d,
                        [&](DartId of_face) { seen[of_face] = true; });
    faces.push_back(face_corners(map, d));
  }
  return faces;
}

}  // namespace gmsim::io
