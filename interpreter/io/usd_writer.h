// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "io/mesh_frame.h"

namespace gmsim::io {

/// A moving surface as USD text (.usda) for Blender and other USD readers: one Mesh whose points
/// are sampled every frame and whose faces are sampled where the topology changes. Times in seconds
/// become time codes, 24 a second from the first frame on.
class UsdText {
 public:
  /// `new_topology`: the cells are not those of the frame before.
  void add_frame(const MeshFrame& frame, bool new_topology);
  /// The whole text.
  [[nodiscard]] std::string finish() const;

 private:
  std::string points_, counts_, indices_;
  double first_time_ = 0, last_code_ = 0;
  bool started_ = false;
};

}  // namespace gmsim::io
