// SPDX-License-Identifier: MIT
#include "io/obj_writer.h"

#include <fmt/format.h>

#include <iterator>

#include "io/surface.h"
#include "io/text_file.h"

namespace gmsim::io {

namespace {

void append_statement(char letter, std::span<const std::int32_t> corners, std::string& text) {
  text += letter;
  for (std::int32_t corner : corners) fmt::format_to(std::back_inserter(text), " {}", corner + 1);
  text += '\n';
}

}  // namespace

std::string obj_text(const MeshFrame& frame) {
  std::string text;
  for (const auto& point : frame.points) {
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", point[0], point[1], point[2]);
  }
  const Surface surface = visible_surface(frame.topology);
  for (std::size_t i = 0; i < surface.size(); ++i) append_statement('f', surface.polygon(i), text);
  for (std::size_t cell = 0; cell < frame.topology.cell_count(); ++cell) {
    if (frame.topology.types[cell] == VtkCell::Line) {
      append_statement('l', frame.topology.corners(cell), text);
    }
  }
  return text;
}

bool write_obj(const std::filesystem::path& path, const MeshFrame& frame,
               support::Diagnostics& diagnostics) {
  return write_file(path, obj_text(frame), diagnostics);
}

}  // namespace gmsim::io
