// SPDX-License-Identifier: MIT
#include "scene/meshio_bridge.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <array>
#include <sstream>

#include "scene/mesh_file.h"
#include "scene/meshio_convert.h"
#include "scene/run_process.h"

namespace gmsim::scene {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;

constexpr int kNoMeshio = 42;  // exit code of the script

/// A new folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "gmsim-XXXXXX").string();
    if (!error && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<std::string> interpreters(const std::string& asked) {
  if (!asked.empty()) return {asked};
  std::vector<std::string> names;
  if (const char* from_environment = getenv("GMSIM_PYTHON")) names.emplace_back(from_environment);
  names.insert(names.end(), {"python3", GMSIM_BUILD_PYTHON});
  return names;
}

/// Runs the conversion with the first program that has meshio.
std::optional<ProcessResult> convert(const std::string& source, const std::string& target,
                                     const std::string& python) {
  for (const std::string& interpreter : interpreters(python)) {
    auto result = run_process({interpreter, "-c", std::string(kMeshioConvert), source, target});
    if (result && result->exit_code != kNoMeshio && result->exit_code != 127) return result;
  }
  if (!python.empty()) return std::nullopt;
  return run_process({"meshio", "convert", "--output-format", "gmsh22", source, target + ".msh"});
}

void report_missing(const std::filesystem::path& path, Diagnostics& diagnostics) {
  auto converted = path.filename();
  converted.replace_extension(".msh");
  diagnostics.report(
      {.kind = DiagnosticKind::FileError,
       .message = fmt::format(
           "{}: reading this format needs meshio, which no Python found here has", path.string()),
       .notes = {"gmsim reads .msh and .obj itself and has meshio convert everything else"},
       .help = fmt::format(
           "`pip install meshio` in a virtual environment whose python GMSIM_PYTHON names, "
           "or convert the file with `meshio convert {} {}`",
           path.string(), converted.string())});
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return last;
}

void report_failed(const std::filesystem::path& path, const ProcessResult& result,
                   Diagnostics& diagnostics) {
  diagnostics.report(
      {.kind = DiagnosticKind::MeshFormat,
       .message = fmt::format("{}: meshio cannot convert this file", path.string()),
       .notes = {result.output.empty() ? fmt::format("it ended with code {}", result.exit_code)
                                       : "it says: " + last_line(result.output)}});
}

/// What the script has to say about the data it left out.
std::vector<std::string> warnings_of(const std::string& output) {
  constexpr std::string_view kMark = "gmsim: ";
  std::vector<std::string> warnings;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kMark)) warnings.push_back(line.substr(kMark.size()));
  }
  return warnings;
}

}  // namespace

std::optional<FileMesh> read_through_meshio(const std::filesystem::path& path,
                                            const std::string& python, Diagnostics& diagnostics) {
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = "no temporary folder can be made for the conversion of a mesh"});
    return std::nullopt;
  }
  const std::string target = (folder.path() / "mesh").string();
  const auto result = convert(std::filesystem::absolute(path).string(), target, python);
  if (!result || result->exit_code == kNoMeshio) {
    report_missing(path, diagnostics);
    return std::nullopt;
  }
  for (const char* extension : {".msh", ".obj"}) {
    if (result->exit_code != 0 || !std::filesystem::exists(target + extension)) continue;
    auto mesh =
        read_mesh_file(target + extension, path.string() + " (converted by meshio)", diagnostics);
    if (!mesh) return std::nullopt;
    for (std::string& warning : warnings_of(result->output))
      mesh->warnings.push_back(std::move(warning));
    return mesh;
  }
  report_failed(path, *result, diagnostics);
  return std::nullopt;
}

}  // namespace gmsim::scene
