// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "check/environment.h"

namespace gmsim::check {

/// Why an item is absent, by dimension (1, 2, 3); empty where it is there.
using Absences = std::vector<std::pair<std::string, std::array<std::string, 3>>>;

/// Reports what checking found in the three dimensions of the map: once what they share, with a note
/// what one alone has. Dimensions 2 and 3 decide; 1 counts where it is the only one that an item can
/// exist in, else an item that does not check there is absent. An item that is absent everywhere is an
/// error. Returns why items are absent.
Absences merge_reports(const ItemTable& items, const std::array<Environment, 3>& environments,
                       support::Diagnostics& diagnostics);

}  // namespace gmsim::check
