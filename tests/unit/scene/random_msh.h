// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <random>

#include "unit/scene/msh_writer.h"

namespace gmsim::test {

/// Points and cells at random, of all kinds, groups and data included; not a sensible mesh.
[[nodiscard]] inline MshContent random_msh(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
  const auto real = [&] { return std::uniform_real_distribution<>(-1e3, 1e3)(random); };
  MshContent content;
  std::uint64_t tag = 0;
  for (std::uint32_t i = 0; i < 8 + below(20); ++i) {
    content.points.push_back({real(), real(), real()});
    content.point_tags.push_back(tag += 1 + below(1000));
  }
  // Tags need not ascend.
  std::shuffle(content.point_tags.begin(), content.point_tags.end(), random);
  constexpr std::array<std::pair<std::int32_t, std::size_t>, 8> kTypes = {
      {{15, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 4}, {5, 8}, {6, 6}, {7, 5}}};
  tag = 0;
  for (std::uint32_t i = 0; i < 1 + below(30); ++i) {
    const auto [type, corners] = kTypes[below(kTypes.size())];
    MshContent::Cell cell{type, static_cast<std::int32_t>(below(3)), tag += 1 + below(5), {}};
    for (std::size_t k = 0; k < corners; ++k) {
      cell.corners.push_back(below(static_cast<std::uint32_t>(content.points.size())));
    }
    content.cells.push_back(std::move(cell));
  }
  content.groups = {{3, 1, "liver"}, {3, 2, "left lobe"}, {2, 1, "skin"}, {1, 2, "rim"}};
  MshContent::Data heat{"heat", 1, content.point_tags, {}};
  for (std::size_t i = 0; i < content.points.size(); ++i) heat.values.push_back(real());
  MshContent::Data fibre{"fibre direction", 3, {}, {}};
  for (const auto& cell : content.cells) {
    if (cell.type == 15) continue;
    fibre.tags.push_back(cell.tag);
    for (int k = 0; k < 3; ++k) fibre.values.push_back(real());
  }
  content.node_data.push_back(std::move(heat));
  content.element_data.push_back(std::move(fibre));
  return content;
}

}  // namespace gmsim::test
