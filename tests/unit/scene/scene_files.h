// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "unit/scene/scene_text.h"

namespace gmsim::test {

/// A folder for scenes and what lies beside them, gone at the end.
class SceneFolder {
 public:
  SceneFolder() {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("gmsim_scene_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(path_);
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// A scene that was loaded, with what was said about it.
struct LoadedScene {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  std::unique_ptr<scene::Scene> scene;

  explicit LoadedScene(const std::filesystem::path& path, const scene::SceneOptions& options = {}) {
    scene = scene::load_scene(path, options, sources, diagnostics);
  }
  [[nodiscard]] std::string rendered() const {
    std::ostringstream out;
    support::render(diagnostics, sources, out);
    return out.str();
  }
  [[nodiscard]] std::string errors() const { return brief(diagnostics, sources); }
  [[nodiscard]] const engine::State& state() const { return *scene->state; }
  [[nodiscard]] types::EmbeddingId id(const std::string& name) const {
    return *scene->program.schema.find(name);
  }
  /// Sum of a stored number over all its orbits that have it.
  [[nodiscard]] double sum(const std::string& name) const {
    double total = 0;
    const auto& rows = state().store.index_of(id(name));
    for (gmap::Row row = 0; row < rows.row_end(); ++row)
      if (rows.alive(row) && state().store.column(id(name)).has(row))
        total += state().store.column(id(name)).get(row)[0];
    return total;
  }
  [[nodiscard]] const engine::ActiveInteraction* active(const std::string& name) const {
    for (const auto& interaction : scene->model.interactions)
      if (scene->program.interactions[interaction.interaction].name == name) return &interaction;
    return nullptr;
  }
  [[nodiscard]] const engine::ParameterBinding& parameter(const std::string& interaction,
                                                          const std::string& name) const {
    const auto& parameters =
        scene->program.interactions[active(interaction)->interaction].parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].name == name) return active(interaction)->parameters[i];
    throw std::runtime_error("no parameter " + name);
  }
};

}  // namespace gmsim::test
