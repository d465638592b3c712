// SPDX-License-Identifier: MIT
#include "view/view_page.h"

#include <yaml-cpp/yaml.h>
#include <zlib.h>

#include <stdexcept>

namespace gmsim::test {

namespace {

using Bytes = std::vector<unsigned char>;

/// The text of `<script … id="ID">`.
std::string script(const std::string& html, const std::string& id) {
  const std::size_t tag = html.find("id=\"" + id + "\">");
  if (tag == std::string::npos) throw std::runtime_error("the page has no " + id);
  const std::size_t begin = html.find('>', tag) + 1;
  return html.substr(begin, html.find("</script>", begin) - begin);
}

Bytes from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) continue;  // padding
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count));
  }
  return bytes;
}

Bytes inflated(const Bytes& packed) {
  for (std::size_t size = 1 << 16;; size *= 4) {
    Bytes bytes(size);
    uLongf length = size;
    const int result = uncompress(bytes.data(), &length, packed.data(), packed.size());
    if (result == Z_BUF_ERROR && size < (std::size_t{1} << 32)) continue;
    if (result != Z_OK) throw std::runtime_error("the block cannot be inflated");
    bytes.resize(length);
    return bytes;
  }
}

/// Reads tables of numbers one after another.
struct Tables {
  const Bytes& block;
  std::size_t at;

  std::vector<std::uint32_t> next(std::size_t count) {
    std::vector<std::uint32_t> numbers;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t byte = 0; byte < 4; ++byte)
        sum += std::uint32_t{block.at(at++)} << (8 * byte);
      numbers.push_back(sum);
    }
    return numbers;
  }
};

ViewPage::Mesh read_mesh(const YAML::Node& node, const Bytes& block) {
  const auto count = [&](const char* name) { return node[name].as<std::size_t>(); };
  Tables tables{block, count("at")};
  ViewPage::Mesh mesh;
  mesh.all_points = count("all_points");
  mesh.all_cells = count("all_cells");
  mesh.outline = count("outline");
  mesh.points = tables.next(count("points"));
  mesh.cells = tables.next(count("cells"));
  mesh.triangles = tables.next(3 * count("triangles"));
  mesh.triangle_cells = tables.next(count("triangles"));
  mesh.edges = tables.next(2 * count("edges"));
  mesh.lines = tables.next(2 * count("lines"));
  mesh.line_cells = tables.next(count("lines"));
  mesh.dots = tables.next(count("dots"));
  mesh.dot_cells = tables.next(count("dots"));
  return mesh;
}

void read_positions(std::size_t at, const Bytes& block, const ViewPage& page,
                    ViewPage::Frame& frame) {
  const std::size_t count = page.meshes[frame.mesh].points.size();
  const bool follows = !page.frames.empty() && page.frames.back().mesh == frame.mesh;
  frame.steps.resize(count);
  frame.positions.resize(count);
  std::uint32_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t low_byte = at + axis * count + i;
      sum += block.at(low_byte) + 256u * block.at(low_byte + 3 * count);
      const std::uint32_t before = follows ? page.frames.back().steps[i][axis] : 0;
      frame.steps[i][axis] = (sum + before) & 0xffff;
      frame.positions[i][axis] =
          page.low[axis] + frame.steps[i][axis] * (page.high[axis] - page.low[axis]) / 65534;
    }
  }
}

ViewPage::Frame read_frame(const YAML::Node& node, const Bytes& block, const ViewPage& page) {
  ViewPage::Frame frame;
  frame.number = node["number"].as<std::int64_t>();
  frame.step = node["step"].as<std::int64_t>();
  frame.time = node["time"].as<double>();
  frame.mesh = node["mesh"].as<std::size_t>();
  frame.tears = node["tears"].as<std::size_t>();
  read_positions(node["positions"].as<std::size_t>(), block, page, frame);
  const ViewPage::Mesh& mesh = page.meshes.at(frame.mesh);
  for (std::size_t i = 0; i < page.fields.size(); ++i) {
    const ViewPage::Field& field = page.fields[i];
    const std::size_t rows = field.on == "point" ? mesh.points.size() : mesh.cells.size();
    const auto at = node["fields"][i].as<std::size_t>();
    auto& steps = frame.value_steps.emplace_back();
    for (std::size_t row = 0; row < rows; ++row) steps.push_back(block.at(at + row));
    auto& values = frame.values.emplace_back();
    for (const std::uint32_t step : steps)
      values.push_back(field.low + (field.high - field.low) * step / 254);
  }
  return frame;
}

}  // namespace

ViewPage read_page(const std::string& html) {
  const YAML::Node head = YAML::Load(script(html, "head"));  // JSON is YAML
  const Bytes block = inflated(from_base64(script(html, "block")));
  ViewPage page;
  page.title = head["title"].as<std::string>();
  page.field = head["field"].as<std::string>();
  page.frames_in_file = head["frames_in_file"].as<std::int64_t>();
  page.complete = head["complete"].as<bool>();
  page.low = head["low"].as<std::array<double, 3>>();
  page.high = head["high"].as<std::array<double, 3>>();
  for (const YAML::Node& node : head["fields"])
    page.fields.push_back({node["name"].as<std::string>(), node["on"].as<std::string>(),
                           node["unit"].as<std::string>(), node["expression"].as<std::string>(),
                           node["low"].as<double>(), node["high"].as<double>()});
  for (const YAML::Node& node : head["meshes"]) page.meshes.push_back(read_mesh(node, block));
  for (const YAML::Node& node : head["frames"])
    page.frames.push_back(read_frame(node, block, page));
  return page;
}

}  // namespace gmsim::test
