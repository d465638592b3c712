// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "engine/state.h"
#include "io/point_numbering.h"
#include "support/diagnostic.h"

namespace gmsim::cli {

/// Writes the map with every stored and derived value of its vertices and elements to `.vtu`, or
/// its surface to `.obj`. Reports other endings and failures.
void write_mesh(const engine::State& state, const io::PointNumbering& points,
                const std::filesystem::path& path, support::Diagnostics& diagnostics);

}  // namespace gmsim::cli
