// SPDX-License-Identifier: MIT
#include "scene/import_mesh.h"

#include <fmt/format.h>

#include "scene/file_mesh.h"
#include "scene/mesh_file.h"
#include "scene/meshio_bridge.h"

namespace gmsim::scene {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;

bool is_readable(const std::filesystem::path& path, Diagnostics& diagnostics) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const char* problem = !std::filesystem::exists(status) ? "there is no such file"
                        : std::filesystem::is_directory(status)
                            ? "this is a folder, not a mesh file"
                            : nullptr;
  if (problem == nullptr) return true;
  diagnostics.report({.kind = DiagnosticKind::FileError,
                      .message = fmt::format("{}: {}", path.string(), problem)});
  return false;
}

std::optional<FileMesh> read_file(const std::filesystem::path& path,
                                  const MeshImportOptions& options, Diagnostics& diagnostics) {
  if (!is_readable(path, diagnostics)) return std::nullopt;
  if (reads_itself(path)) return read_mesh_file(path, path.string(), diagnostics);
  if (path.extension() == ".vtkhdf" || path.extension() == ".part") {
    diagnostics.report(
        {.kind = DiagnosticKind::MeshFormat,
         .message = fmt::format("{}: a trajectory cannot be read as a mesh", path.string()),
         .help = fmt::format("`gmsim export {} -o FOLDER` writes every frame as a .vtu, which can",
                             path.string())});
    return std::nullopt;
  }
  return read_through_meshio(path, options.python, diagnostics);
}

}  // namespace

std::optional<ImportedMesh> import_mesh_with_data(const std::filesystem::path& path,
                                                  const MeshImportOptions& options,
                                                  Diagnostics& diagnostics) {
  auto mesh = read_file(path, options, diagnostics);
  if (!mesh) return std::nullopt;
  return select_cells(std::move(*mesh), options, path.string(), diagnostics);
}

std::optional<gmap::Mesh> import_mesh(const std::filesystem::path& path,
                                      const MeshImportOptions& options, Diagnostics& diagnostics) {
  auto imported = import_mesh_with_data(path, options, diagnostics);
  if (!imported) return std::nullopt;
  return std::move(imported->mesh);
}

std::optional<gmap::Mesh> import_mesh(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return import_mesh(path, MeshImportOptions{}, diagnostics);
}

}  // namespace gmsim::scene
