// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gmap/gmap.h"
#include "gmap/mesh.h"

namespace gmsim::io {

/// A volume that has the structure of a solid: the dart at each corner, in the order of gmap::Mesh.
struct SolidMatch {
  gmap::Mesh::CellKind kind;
  std::vector<gmap::DartId> corners;
};

/// Compares volumes, dart by dart and link by link, with the four solids that have a VTK type.
class SolidRecognizer {
 public:
  SolidRecognizer();
  /// `darts`: the volume <0,1,2>, ascending. Tries the smallest dart as the first corner first.
  [[nodiscard]] std::optional<SolidMatch> match(const gmap::GMap& map,
                                                std::span<const gmap::DartId> darts) const;

 private:
  struct Step {
    std::uint8_t from;  ///< reference dart that is already placed
    std::uint8_t link;
    std::uint8_t to;
  };
  struct Reference {
    gmap::Mesh::CellKind kind;
    std::size_t corner_count;
    std::vector<std::uint8_t> corner;  ///< by reference dart
    std::array<std::vector<std::uint8_t>, 3> alpha;
    std::vector<Step> steps;  ///< reach every dart from dart 0
  };
  static Reference make_reference(gmap::Mesh::CellKind kind);
  static bool place(const Reference& reference, const gmap::GMap& map, gmap::DartId first,
                    std::vector<gmap::DartId>& images);

  std::vector<Reference> references_;
};

using Face = std::vector<gmap::DartId>;

/// The corners of the face of `d` in order: around it when it is closed, from end to end when not.
[[nodiscard]] Face face_corners(const gmap::GMap& map, gmap::DartId d);

/// The faces of a volume, all seen from the same side when it is orientable.
[[nodiscard]] std::vector<Face> volume_faces(const gmap::GMap& map,
                                             std::span<const gmap::DartId> darts);

}  // namespace gmsim::io
