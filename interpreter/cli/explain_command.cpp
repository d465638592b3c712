// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "cli/commands.h"
#include "cli/scene_session.h"

namespace gmsim::cli {

int run_explain(Session& session) {
  const auto scene = load_scene(session);
  if (!scene) return session.finish();
  const auto simulation = make_simulation(session, *scene);
  if (!simulation) return session.finish();
  for (const scene::BodySummary& body : scene->bodies)
    session.out << fmt::format("body `{}`: {} points, {} cells\n", body.name,
                               body.vertices.size(), body.cells);
  session.out << simulation->explain();
  return session.finish();
}

}  // namespace gmsim::cli
