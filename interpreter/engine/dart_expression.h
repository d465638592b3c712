// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "types/expr.h"

namespace gmsim::engine {

/// An expression that the engine evaluates at a dart, with its own frame.
struct DartExpression {
  types::ExprPtr value;
  types::Slot dart{};
  std::uint32_t frame_size = 1;
};

}  // namespace gmsim::engine
