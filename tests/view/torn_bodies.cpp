// SPDX-License-Identifier: MIT
#include "view/torn_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace gmsim::test {

namespace {

using Point = std::array<double, 3>;
/// Where a point of the undeformed body is at a time from 0 to 1; `right` of the cut or not.
using Motion = std::function<Point(const Point& at, bool right, double time)>;

double time_of(std::int64_t frame) {
  return static_cast<double>(frame) / (kTornFrames - 1);
}

/// A body on a grid with a cut in the plane of x = middle. `split` says which of the grid's points
/// in that plane have two numbers by now.
struct CutGrid {
  std::array<int, 3> cells;
  std::function<bool(int y, int z)> split;

  [[nodiscard]] int middle() const { return cells[0] / 2; }
  [[nodiscard]] std::int32_t number(int x, int y, int z) const {
    return (z * (cells[1] + 1) + y) * (cells[0] + 1) + x;
  }
  /// The numbers of the right halves of split points follow those of the grid.
  [[nodiscard]] std::vector<std::int32_t> right_halves() const {
    std::int32_t next = number(0, 0, cells[2] + 1);
    std::vector<std::int32_t> halves(static_cast<std::size_t>(next), -1);
    for (int z = 0; z <= cells[2]; ++z)
      for (int y = 0; y <= cells[1]; ++y)
        if (split(y, z)) halves[static_cast<std::size_t>(number(middle(), y, z))] = next++;
    return halves;
  }
};

void add_points(const CutGrid& grid, const Motion& motion, double time, TornFrame& frame) {
  const auto halves = grid.right_halves();
  const auto add = [&](int x, int y, int z, bool right) {
    const Point at = {1.0 * x, 1.0 * y, 1.0 * z};
    const Point now = motion(at, right, time), before = motion(at, right, time - 1e-3);
    frame.points.push_back(now);
    for (std::size_t axis = 0; axis < 3; ++axis)
      frame.speed.push_back((now[axis] - before[axis]) / 1e-3);
  };
  for (const bool second : {false, true})
    for (int z = 0; z <= grid.cells[2]; ++z)
      for (int y = 0; y <= grid.cells[1]; ++y)
        for (int x = 0; x <= grid.cells[0]; ++x)
          if (!second || halves[static_cast<std::size_t>(grid.number(x, y, z))] >= 0)
            add(x, y, z, second || x > grid.middle());
  frame.tears = static_cast<std::size_t>(std::ssize(frame.points) - std::ssize(halves));
}

void add_cell(const CutGrid& grid, const std::vector<std::int32_t>& halves, int x, int y, int z,
              TornFrame& frame) {
  const bool right = x >= grid.middle(), solid = grid.cells[2] > 0;
  const auto corner = [&](int i, int j, int k) {
    const std::int32_t number = grid.number(x + i, y + j, z + k);
    const std::int32_t half = halves[static_cast<std::size_t>(number)];
    return right && half >= 0 ? half : number;
  };
  std::vector<std::int32_t> corners;
  for (int k = 0; k <= (solid ? 1 : 0); ++k)
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      corners.push_back(corner(i, j, k));
  frame.mesh.add_cell(solid ? io::VtkCell::Hexahedron : io::VtkCell::Quad, corners);
  frame.side.push_back(right ? 1 : 0);
}

TornFrame torn_grid(const CutGrid& grid, const Motion& motion, double time) {
  TornFrame frame;
  add_points(grid, motion, time, frame);
  const auto halves = grid.right_halves();
  for (int z = 0; z < std::max(grid.cells[2], 1); ++z)
    for (int y = 0; y < grid.cells[1]; ++y)
      for (int x = 0; x < grid.cells[0]; ++x) add_cell(grid, halves, x, y, z, frame);
  return frame;
}

}  // namespace

TornFrame torn_sheet(std::int64_t frame) {
  const double time = time_of(frame);
  const CutGrid grid{{24, 16, 0}, [&](int y, int) { return y < 14 * time; }};
  return torn_grid(grid, [](const Point& at, bool right, double t) {
    const double drop = 16 - at[1];
    const double gap = (right ? 0.25 : -0.25) * t * drop * std::max(0.0, 1 - at[1] / 16);
    return Point{at[0] + gap, 0.12 * drop * std::sin(0.5 * at[0] + 9 * t), at[1]};
  }, time);
}

TornFrame torn_block(std::int64_t frame) {
  const double time = time_of(frame);
  const CutGrid grid{{10, 4, 5}, [&](int, int z) { return 5 - z < 5 * time; }};
  return torn_grid(grid, [](const Point& at, bool right, double t) {
    const double angle = (right ? 0.5 : -0.5) * t, x = at[0] - 5, z = at[2];
    return Point{std::cos(angle) * x + std::sin(angle) * z, at[1],
                 std::cos(angle) * z - std::sin(angle) * x};
  }, time);
}

TornFrame torn_chain(std::int64_t frame) {
  const double time = time_of(frame);
  constexpr int kLinks = 12;
  const bool parted = time > 0.5;
  TornFrame chain;
  const auto add_point = [&](double along, double fallen) {
    const double angle = 0.8 * std::cos(7 * time);
    chain.points.push_back({along * std::sin(angle), 0.0, -along * std::cos(angle) - fallen});
    chain.speed.insert(chain.speed.end(), {-along * 5.6 * std::sin(7 * time), 0.0, 0.0});
  };
  const double fallen = parted ? 20 * (time - 0.5) * (time - 0.5) : 0;
  for (int i = 0; i <= kLinks; ++i) add_point(i, i > kLinks / 2 ? fallen : 0);
  if (parted) add_point(kLinks / 2, fallen);
  for (std::int32_t i = 0; i < kLinks; ++i) {
    const std::int32_t begin = parted && i == kLinks / 2 ? kLinks + 1 : i;
    chain.mesh.add_cell(io::VtkCell::Line, std::array{begin, i + 1});
    chain.side.push_back(i < kLinks / 2 ? 0 : 1);
  }
  chain.mesh.add_cell(io::VtkCell::Vertex, std::array<std::int32_t, 1>{kLinks});
  chain.side.push_back(1);
  chain.tears = parted ? 1 : 0;
  return chain;
}

}  // namespace gmsim::test
