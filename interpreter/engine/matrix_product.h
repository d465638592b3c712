// SPDX-License-Identifier: MIT
#pragma once

#include "types/value_type.h"

namespace gmsim::engine {

/// The product of two matrices, or of a matrix and a vector, in the layouts of
/// types::component_count. Sums run along the rows of the left one, from the first entry.
void multiply(types::ValueKind left, const double* a, types::ValueKind right, const double* b,
              double* out);

}  // namespace gmsim::engine
