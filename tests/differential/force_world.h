// SPDX-License-Identifier: MIT
// A model of every interaction of the library on a shaken mesh, and arithmetic on its vertices.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/force_field.h"
#include "library_world.h"

namespace gmsim::tests {

using engine::VertexRecord;
using Records = std::vector<VertexRecord>;

/// Every interaction for which `wanted` holds, each parameter in its column or, when `uniform`, the
/// same everywhere.
inline engine::Model model_of(const compile::Program& program, bool uniform,
                              const std::function<bool(const compile::InteractionBody&)>& wanted) {
  engine::Model model;
  for (std::uint32_t i = 0; i < program.interactions.size(); ++i) {
    const compile::InteractionBody& body = program.interaction_bodies[i];
    if (!wanted(body)) continue;
    engine::ActiveInteraction active{.interaction = i, .parameters = {}, .span = {}};
    for (const auto& parameter : body.parameters) {
      engine::ParameterBinding binding{.embedding = *parameter.embedding, .uniform = {},
                                       .expression = {}};
      binding.kind = uniform ? engine::ParameterBinding::Kind::Uniform
                             : engine::ParameterBinding::Kind::Stored;
      binding.uniform = {parameter.type,
                         std::vector<double>(types::component_count(parameter.type), 0.75)};
      active.parameters.push_back(std::move(binding));
    }
    model.interactions.push_back(std::move(active));
  }
  return model;
}

class ForceWorld : public LibraryWorld {
 public:
  using LibraryWorld::LibraryWorld;

  /// Vertices that `fixed` marks are free again.
  void free_all() {
    auto& column = state().store.column(embedding("fixed"));
    for (gmap::Row row = 0; row < column.row_end(); ++row) column.set(row, std::array{0.0});
  }
  [[nodiscard]] const gmap::OrbitIndex& vertices() {
    return state().store.index_of(world().position);
  }
  [[nodiscard]] engine::Motion motion() {
    return {records("position"), records("velocity")};
  }
  [[nodiscard]] Records records(const std::string& name) {
    const auto& column = state().store.column(embedding(name));
    Records result(vertices().row_end());
    for (gmap::Row row = 0; row < result.size(); ++row) {
      const auto value = column.get(row);
      result[row] = {value[0], value[1], value[2], 0};
    }
    return result;
  }
  /// Sum of corner masses, by vertex row.
  [[nodiscard]] std::vector<double> masses() {
    std::vector<double> result(vertices().row_end(), 0);
    const auto id = embedding("corner_mass");
    const auto& corners = state().store.index_of(id);
    for (gmap::Row row = 0; row < corners.row_end(); ++row)
      if (corners.alive(row))
        result[vertices().row(corners.smallest(row))] += state().store.column(id).get(row)[0];
    return result;
  }
};

inline double dot(const Records& a, const Records& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i].x * b[i].x + a[i].y * b[i].y + a[i].z * b[i].z;
  return sum;
}
inline Records scaled(double s, Records a) {
  for (VertexRecord& r : a) r = {s * r.x, s * r.y, s * r.z, 0};
  return a;
}
inline Records plus(Records a, const Records& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    a[i] = {a[i].x + b[i].x, a[i].y + b[i].y, a[i].z + b[i].z, 0};
  return a;
}
inline double largest(const Records& a) {
  double result = 0;
  for (const VertexRecord& r : a)
    result = std::max({result, std::abs(r.x), std::abs(r.y), std::abs(r.z)});
  return result;
}
inline Records random_records(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Records result(count);
  for (VertexRecord& r : result) r = {uniform(random), uniform(random), uniform(random), 0};
  return result;
}

}  // namespace gmsim::tests
