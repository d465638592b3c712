// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gmsim::test {

/// What a page holds, read back from its text by the description in interpreter/io/viewer/README.md
/// and by nothing that wrote it. Throws std::runtime_error when the page does not hold it.
struct ViewPage {
  struct Field {
    std::string name, on, unit, expression;
    double low = 0, high = 0;
  };
  struct Mesh {
    std::size_t all_points = 0, all_cells = 0, outline = 0;
    std::vector<std::uint32_t> points, cells, triangles, triangle_cells, edges, lines, line_cells,
        dots, dot_cells;
  };
  struct Frame {
    std::int64_t number = 0, step = 0;
    double time = 0;
    std::size_t mesh = 0, tears = 0;
    std::vector<std::array<std::uint32_t, 3>> steps;      ///< by point; 65535: not finite
    std::vector<std::array<double, 3>> positions;         ///< by point
    std::vector<std::vector<std::uint32_t>> value_steps;  ///< by field; 255: not finite
    std::vector<std::vector<double>> values;              ///< by field
  };

  std::string title, field;
  std::int64_t frames_in_file = 0;
  bool complete = false;
  std::array<double, 3> low = {}, high = {};
  std::vector<Field> fields;
  std::vector<Mesh> meshes;
  std::vector<Frame> frames;
};

[[nodiscard]] ViewPage read_page(const std::string& html);

}  // namespace gmsim::test
