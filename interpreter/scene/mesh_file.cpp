// SPDX-License-Identifier: MIT
#include "scene/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

namespace gmsim::scene {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<std::string> read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) return std::nullopt;
  return bytes;
}

void report(const std::string& name, const MeshFileError& error, Diagnostics& diagnostics) {
  const std::string place = error.line   ? fmt::format(":{}", *error.line)
                            : error.byte ? fmt::format(": byte {}", *error.byte)
                                         : "";
  diagnostics.report({.kind = DiagnosticKind::MeshFormat,
                      .message = fmt::format("{}{}: {}", name, place, error.message)});
}

}  // namespace

bool reads_itself(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".msh" || extension == ".obj";
}

std::optional<FileMesh> read_mesh_file(const std::filesystem::path& path, const std::string& name,
                                       Diagnostics& diagnostics) {
  const auto bytes = read_bytes(path);
  if (!bytes) {
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("{}: the file cannot be read", name)});
    return std::nullopt;
  }
  try {
    return extension_of(path) == ".obj" ? read_obj(*bytes) : read_msh(*bytes);
  } catch (const MeshFileError& error) {
    report(name, error, diagnostics);
    return std::nullopt;
  }
}

}  // namespace gmsim::scene
