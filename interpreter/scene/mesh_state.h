// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/state.h"
#include "gmap/mesh.h"

namespace gmsim::scene {

/// Puts the points of a mesh into the embedding `position`, at every vertex of the map that was
/// built from it. `dart_point` as in gmap::MeshMap; m.
void set_positions(engine::State& state, const gmap::Mesh& mesh,
                   const std::vector<std::uint32_t>& dart_point);

/// Puts the mass of every cell, density times its measure, into `corner_mass`: equal shares for
/// the cell's corners (paper, 3.3). `dart_cell` as in gmap::MeshMap; density in kg per m, m^2 or
/// m^3 after the dimension of the map.
void set_corner_masses(engine::State& state, const gmap::Mesh& mesh,
                       const std::vector<std::uint32_t>& dart_cell, double density);

/// The embeddings with role Data that lack a value somewhere: neither the mesh nor a default gives
/// one.
[[nodiscard]] std::vector<std::string> missing_embeddings(const engine::State& state);

}  // namespace gmsim::scene
