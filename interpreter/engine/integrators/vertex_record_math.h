// SPDX-License-Identifier: MIT
#pragma once

#include "engine/force_field.h"

/// Arithmetic on whole records. All four lanes are computed, so that a loop over records is a loop
/// over full vector registers.
namespace gmsim::engine {

[[nodiscard]] inline VertexRecord operator+(const VertexRecord& a, const VertexRecord& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
[[nodiscard]] inline VertexRecord operator-(const VertexRecord& a, const VertexRecord& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
[[nodiscard]] inline VertexRecord operator*(double s, const VertexRecord& a) {
  return {s * a.x, s * a.y, s * a.z, s * a.w};
}
[[nodiscard]] inline double dot(const VertexRecord& a, const VertexRecord& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline VertexRecord cross(const VertexRecord& a, const VertexRecord& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x, 0};
}

}  // namespace gmsim::engine
