// SPDX-License-Identifier: MIT
// Wavefront .obj. tinyobjloader reads the statements; since it takes any text for a number and has
// no line numbers to report, the lines are checked here first, and only those that shape a mesh
// (v, f, l, g, o) are handed on.
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "scene/mesh_bytes.h"

namespace gmsim::scene {

namespace {

/// A face or polyline that passed the check, in the order of the file.
struct Statement {
  std::size_t line;
  bool is_face;
  std::size_t corners;
  std::size_t points_before;  ///< what relative corner numbers count back from
};

struct CheckedText {
  std::string text;  ///< for tinyobjloader; polylines stand as faces, which it reports alike
  std::vector<Statement> statements;
  std::vector<std::array<double, 3>> points;
};

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r\v\f";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;
       at = line.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

[[noreturn]] void fail(std::size_t line, std::string message) {
  throw MeshFileError{std::move(message), line, std::nullopt};
}

void check_vertex(std::size_t line, const std::vector<std::string_view>& words,
                  CheckedText& checked) {
  if (words.size() < 4) fail(line, "a vertex needs three coordinates");
  std::array<double, 3> point;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto value = parse_real(words[i]);
    if (!value) fail(line, fmt::format("`{}` is not a finite number", shown(words[i])));
    // Kept from here: the reader of tinyobjloader is off by a last digit (0.3 becomes 3 * 0.1).
    if (i <= 3) point[i - 1] = *value;
  }
  checked.points.push_back(point);
}

/// The first part of `7`, `7/1`, `7//3` or `7/1/3`; empty when it is something else.
std::optional<std::int64_t> vertex_number(std::string_view word) {
  std::optional<std::int64_t> vertex;
  for (int part = 0; part < 3; ++part) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const auto number = parse_integer(word.substr(0, slash));
    const bool left_empty = part > 0 && slash == 0;
    if (!number && !left_empty) return std::nullopt;
    if (part == 0) vertex = number == 0 ? std::nullopt : number;
    if (slash == word.size()) return vertex;
    word.remove_prefix(slash + 1);
  }
  return std::nullopt;
}

/// Vertices are numbered from 1, or from -1 backwards.
void check_corner(std::size_t line, std::string_view word, std::size_t points) {
  const auto value = vertex_number(word);
  if (!value) fail(line, fmt::format("`{}` is not a vertex number", shown(word)));
  const auto last = static_cast<std::int64_t>(points);
  if (*value > last || *value < -last) {
    fail(line,
         fmt::format("vertex {} does not exist; there are {} before this line", *value, points));
  }
}

void check_element(std::size_t line, const std::vector<std::string_view>& words,
                   CheckedText& checked) {
  const bool is_face = words[0] == "f";
  const std::size_t corners = words.size() - 1;
  if (is_face && corners < 3) fail(line, fmt::format("a face with {} corners", corners));
  if (!is_face && corners < 2) fail(line, fmt::format("a line with {} ends", corners));
  for (std::size_t i = 1; i < words.size(); ++i)
    check_corner(line, words[i], checked.points.size());
  checked.statements.push_back({line, is_face, corners, checked.points.size()});
}

void check_line(std::size_t number, std::string_view line, CheckedText& checked) {
  const auto words = words_of(line.substr(0, line.find('#')));
  if (words.empty()) return;
  if (words[0] == "v") {
    check_vertex(number, words, checked);
  } else if (words[0] == "f" || words[0] == "l") {
    check_element(number, words, checked);
  } else if (words[0] != "g" && words[0] != "o") {
    return;
  }
  checked.text += words[0] == "l" ? "f" : words[0];
  for (std::size_t i = 1; i < words.size(); ++i) checked.text.append(" ").append(words[i]);
  if (words.size() == 1) checked.text += " ";
  checked.text += '\n';
}

CheckedText check(std::string_view bytes) {
  const std::size_t null = bytes.find('\0');
  MeshBytes in(bytes);
  if (null != std::string_view::npos) in.fail_at(null, "a null byte: this is not a text file");
  CheckedText checked;
  for (std::size_t number = 1; !in.at_end(); ++number)
    check_line(number, in.rest_of_line(), checked);
  return checked;
}

/// Receives what tinyobjloader reads.
struct Collector {
  explicit Collector(const CheckedText& text) : checked(text) {}

  const CheckedText& checked;
  FileMesh mesh;
  std::size_t next = 0;
  std::map<std::string, std::int32_t> region_of_name;
  std::int32_t region = 0;
  bool readings_differ = false;  ///< tinyobjloader finds other statements than the check did

  void element(const tinyobj::index_t* corners, int count) {
    if (next == checked.statements.size() ||
        checked.statements[next].corners != static_cast<std::size_t>(count)) {
      readings_differ = true;
      return;
    }
    const Statement& statement = checked.statements[next++];
    std::vector<std::uint32_t> points;
    for (int i = 0; i < count; ++i) {
      const std::int64_t number = corners[i].vertex_index;
      const auto before = static_cast<std::int64_t>(statement.points_before);
      points.push_back(static_cast<std::uint32_t>(number < 0 ? before + number : number - 1));
    }
    if (statement.is_face) {
      mesh.corners.insert(mesh.corners.end(), points.begin(), points.end());
      mesh.close_cell(CellKind::Polygon, region);
      return;
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      mesh.corners.insert(mesh.corners.end(), {points[i], points[i + 1]});
      mesh.close_cell(CellKind::Segment, region);
    }
  }

  /// Groups and objects are numbered from 1 in the order in which they first appear.
  void begin_region(const std::string& name) {
    if (name.empty()) {
      region = 0;
      return;
    }
    const auto number = static_cast<std::int32_t>(region_of_name.size()) + 1;
    region = region_of_name.emplace(name, number).first->second;
    for (int dimension : {1, 2}) mesh.region_names[{dimension, region}] = name;
  }
};

}  // namespace

FileMesh read_obj(std::string_view bytes) {
  const CheckedText checked = check(bytes);
  Collector collector(checked);
  tinyobj::callback_t callbacks;
  callbacks.index_cb = [](void* data, tinyobj::index_t* corners, int count) {
    static_cast<Collector*>(data)->element(corners, count);
  };
  callbacks.group_cb = [](void* data, const char** names, int count) {
    static_cast<Collector*>(data)->begin_region(count > 0 ? names[0] : "");
  };
  callbacks.object_cb = [](void* data, const char* name) {
    static_cast<Collector*>(data)->begin_region(name);
  };
  std::istringstream text(checked.text);
  std::string error;
  if (!tinyobj::LoadObjWithCallback(text, callbacks, &collector, nullptr, nullptr, &error)) {
    throw MeshFileError{error, std::nullopt, std::nullopt};
  }
  if (collector.readings_differ || collector.next != checked.statements.size()) {
    throw MeshFileError{"the faces and lines of this file can be read in two ways", std::nullopt,
                        std::nullopt};
  }
  collector.mesh.points = checked.points;
  return std::move(collector.mesh);
}

}  // namespace gmsim::scene
