// SPDX-License-Identifier: MIT
#include "scene/mesh_spec.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "gmap/mesh_builders.h"
#include "scene/import_mesh.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;

/// More cells than a map of 32-bit darts can hold are a slip of the pen.
constexpr std::uint64_t kMaxCells = 50'000'000;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// "4x2x1" as `count` positive numbers.
template <class Number>
std::optional<std::vector<Number>> read_sizes(const std::string& text, std::size_t count) {
  std::vector<Number> sizes;
  for (const std::string& part : split(text, 'x')) {
    Number value{};
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size() || !(value > 0)) return {};
    sizes.push_back(value);
  }
  if (sizes.size() != count) return {};
  return sizes;
}

template <class Kind>
struct NamedKind {
  const char* name;
  Kind kind;
};
constexpr NamedKind<gmap::GridCells> kGridCells[] = {{"quads", gmap::GridCells::Quads},
                                                     {"triangles", gmap::GridCells::Triangles},
                                                     {"tri4", gmap::GridCells::Tri4},
                                                     {"mix2", gmap::GridCells::Mix2},
                                                     {"mix4", gmap::GridCells::Mix4}};
constexpr NamedKind<gmap::BoxElements> kBoxElements[] = {{"hexes", gmap::BoxElements::Hexes},
                                                         {"tets6", gmap::BoxElements::Tets6},
                                                         {"tets5", gmap::BoxElements::Tets5}};

/// One mesh specification being read; every message names it as a whole.
class SpecReader {
 public:
  SpecReader(const std::string& spec, Diagnostics& diagnostics)
      : spec_(spec), parts_(split(spec, ':')), diagnostics_(diagnostics) {}

  [[nodiscard]] const std::string& builder() const { return parts_.front(); }

  std::optional<gmap::Mesh> grid() {
    const auto kind = read_kind(kGridCells, "grid:quads:10x10 or grid:quads:10x10:1x0.5");
    const auto counts = read<std::uint32_t>(2, 2);
    const auto size = read<double>(3, 2);
    if (!kind || !counts || !size) return {};
    return gmap::grid((*counts)[0], (*counts)[1], (*size)[0], (*size)[1], *kind);
  }

  std::optional<gmap::Mesh> box() {
    const auto kind = read_kind(kBoxElements, "box:hexes:4x2x2 or box:hexes:4x2x2:1x0.5x0.5");
    const auto counts = read<std::uint32_t>(2, 3);
    const auto size = read<double>(3, 3);
    if (!kind || !counts || !size) return {};
    return gmap::box({(*counts)[0], (*counts)[1], (*counts)[2]},
                     {(*size)[0], (*size)[1], (*size)[2]}, *kind);
  }

  std::optional<gmap::Mesh> chain() {
    if (parts_.size() < 2 || parts_.size() > 3) return fail("write chain:10 or chain:10:2.5");
    const auto count = read<std::uint32_t>(1, 1);
    const auto length = read<double>(2, 1);
    if (!count || !length) return {};
    return gmap::chain(count->front(), length->front());
  }

 private:
  std::nullopt_t fail(const std::string& help) {
    diagnostics_.report({.kind = DiagnosticKind::Usage,
                         .message = fmt::format("the mesh `{}` is not understood", spec_),
                         .help = help});
    return std::nullopt;
  }

  template <class Kind, std::size_t N>
  std::optional<Kind> read_kind(const NamedKind<Kind> (&kinds)[N], const std::string& example) {
    if (parts_.size() < 3 || parts_.size() > 4) return fail("write " + example);
    std::vector<std::string> names;
    for (const auto& kind : kinds) {
      if (parts_[1] == kind.name) return kind.kind;
      names.emplace_back(kind.name);
    }
    const std::string guess = support::did_you_mean(parts_[1], names);
    return fail(fmt::format("cells of a {} are {}{}{}", builder(), fmt::join(names, ", "),
                            guess.empty() ? "" : "; ", guess));
  }

  /// The sizes at `position`; absent sizes are 1.
  template <class Number>
  std::optional<std::vector<Number>> read(std::size_t position, std::size_t count) {
    if (position >= parts_.size()) return std::vector<Number>(count, Number{1});
    auto sizes = read_sizes<Number>(parts_[position], count);
    if (!sizes)
      return fail(fmt::format("`{}` must be {} positive number{} joined by x", parts_[position],
                              count, count == 1 ? "" : "s"));
    if constexpr (std::is_integral_v<Number>) {
      std::uint64_t cells = 1;
      for (const Number size : *sizes) {
        cells *= size;
        if (cells > kMaxCells) return fail(fmt::format("at most {} cells fit", kMaxCells));
      }
    }
    return sizes;
  }

  const std::string& spec_;
  std::vector<std::string> parts_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<gmap::Mesh> mesh_from_spec(const std::string& spec, Diagnostics& diagnostics) {
  SpecReader reader(spec, diagnostics);
  if (reader.builder() == "grid") return reader.grid();
  if (reader.builder() == "box") return reader.box();
  if (reader.builder() == "chain") return reader.chain();
  return import_mesh(spec, diagnostics);
}

}  // namespace gmsim::scene
