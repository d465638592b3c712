// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "compile/rewrite_plan.h"

namespace gmsim::compile {

/// Numbers what the values of one rule compute again and again on the same map, so that an
/// evaluator may keep it. The values stay the same, bit for bit. Two things get a number, from 1:
///
/// * A Fold over an orbit, or over the orbits in it, whose terms depend on the visited dart alone.
///   Its value is the same at every dart of the orbit.
/// * What depends on one dart alone and is written in several places; it is put into a
///   Let(dart, value), which carries the number.
///
/// Equal numbers mean the same function of a dart, whatever its locals are called. `positions` is
/// the length of the rule's labels.
void share_values(std::span<Assignment> assignments, std::uint32_t positions);

}  // namespace gmsim::compile
