// SPDX-License-Identifier: MIT
#include "scene/file_mesh.h"

using namespace gmsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    scene::FileMesh mesh = scene::read_obj({reinterpret_cast<const char*>(data), size});
    support::Diagnostics diagnostics;
    const auto chosen = scene::select_cells(std::move(mesh), {}, "input", diagnostics);
    if (!chosen && !diagnostics.has_errors()) __builtin_trap();
  } catch (const scene::MeshFileError& error) {
    if (error.message.empty()) __builtin_trap();
  }
  return 0;
}
