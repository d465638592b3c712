// SPDX-License-Identifier: MIT
#pragma once

// Internal to this module: where things stand in a trajectory, and reading what is fixed.

#include <string>

#include "io/hdf5_handles.h"
#include "io/trajectory_schema.h"

namespace gmsim::io {

/// Datasets of a field; those that its place does not have are empty.
struct FieldPaths {
  std::string values, offsets, sizes, darts;
};
[[nodiscard]] FieldPaths paths_of(const FieldDescription& field);

/// Throws unless the file is a trajectory of this version.
void check_format(hid_t file);
[[nodiscard]] RunDescription read_run_description(hid_t file);

}  // namespace gmsim::io
