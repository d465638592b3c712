// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "unit/scene/scene_files.h"

using namespace gmsim;
using test::exchanged;
using test::kCloth;
using test::LoadedScene;
using test::SceneFolder;

namespace {

std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

TEST_CASE("every scene of the project loads") {
  for (const auto& path : scenes_below("scenes")) {
    INFO(path.string());
    const LoadedScene loaded(path);
    CHECK(loaded.rendered() == "");
    CHECK(loaded.scene != nullptr);
  }
}
