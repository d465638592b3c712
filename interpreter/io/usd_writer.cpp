// SPDX-License-Identifier: MIT
#include "io/usd_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "io/surface.h"
#include "support/check.h"

namespace gmsim::io {

namespace {

constexpr double kCodesPerSecond = 24;

}  // namespace

void UsdText::add_frame(const MeshFrame& frame, bool new_topology) {
  GMSIM_CHECK(frame.time.has_value(), "a frame of a moving surface needs a time");
  if (!started_) first_time_ = *frame.time;
  last_code_ = (*frame.time - first_time_) * kCodesPerSecond;
  fmt::format_to(std::back_inserter(points_), "            {}: [", last_code_);
  const char* separator = "";
  for (const auto& point : frame.points) {
    fmt::format_to(std::back_inserter(points_), "{}({}, {}, {})", separator, point[0], point[1],
                   point[2]);
    separator = ", ";
  }
  points_ += "],\n";
  if (new_topology || !started_) {
    const Surface surface = visible_surface(frame.topology);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < surface.size(); ++i) sizes.push_back(surface.polygon(i).size());
    fmt::format_to(std::back_inserter(counts_), "            {}: {},\n", last_code_, sizes);
    fmt::format_to(std::back_inserter(indices_), "            {}: {},\n", last_code_,
                   surface.corners);
  }
  started_ = true;
}

std::string UsdText::finish() const {
  return fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"body\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n"
      "    startTimeCode = 0\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n)\n\n"
      "def Mesh \"body\"\n{{\n    uniform token subdivisionScheme = \"none\"\n"
      "    point3f[] points.timeSamples = {{\n{}    }}\n"
      "    int[] faceVertexCounts.timeSamples = {{\n{}    }}\n"
      "    int[] faceVertexIndices.timeSamples = {{\n{}    }}\n}}\n",
      last_code_, kCodesPerSecond, points_, counts_, indices_);
}

}  // namespace gmsim::io
