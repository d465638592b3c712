// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gmsim::io {

/// Appends polygon.size() - 2 triangles that cover a polygon of point numbers, turned as it is.
/// Ears are cut off in the plane that the polygon is nearest to (Meisters 1975), so that it need
/// not be convex; one that crosses itself or has no area gives some triangles or other.
void triangulate(std::span<const std::int32_t> polygon,
                 std::span<const std::array<double, 3>> points,
                 std::vector<std::int32_t>& triangles);

}  // namespace gmsim::io
