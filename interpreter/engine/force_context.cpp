// SPDX-License-Identifier: MIT
#include "engine/force_context.h"

#include <algorithm>
#include <utility>

#include "support/check.h"

namespace gmsim::engine {

namespace {

using compile::ValueSource;
using compile::ValueSources;

EmbeddingId find_position(const State& state) {
  const auto position = state.program.schema.find("position");
  GMSIM_CHECK(position && state.store.in_use(*position), "forces need positions");
  return *position;
}

std::vector<bool> moving_values(const State& state, const std::vector<ActiveInteraction>& active,
                                EmbeddingId position, std::optional<EmbeddingId> velocity) {
  std::vector<EmbeddingId> moving{position};
  if (velocity) moving.push_back(*velocity);
  for (const ActiveInteraction& interaction : active)
    for (const ParameterBinding& parameter : interaction.parameters)
      if (parameter.kind == ParameterBinding::Kind::OfTime) moving.push_back(parameter.embedding);
  return compile::values_in_motion(state.program.schema, moving);
}

ValueSource source_of(const ParameterBinding& parameter) {
  switch (parameter.kind) {
    case ParameterBinding::Kind::Uniform:
      return ValueSource::uniform(parameter.uniform.data);
    case ParameterBinding::Kind::Stored:
      return ValueSource::gathered();
    case ParameterBinding::Kind::OfTime:
      return ValueSource::expression(parameter.expression.value, ValueSource::Frame::ReadDart,
                                     parameter.expression.dart, parameter.expression.frame_size);
  }
  return ValueSource::missing();
}

ValueSources all_sources(const State& state, const std::vector<ActiveInteraction>& active,
                         std::optional<EmbeddingId> velocity,
                         const std::vector<bool>& in_motion) {
  const gmap::EmbeddingSchema& schema = state.program.schema;
  ValueSources sources = compile::stored_sources(schema, state.store);
  for (std::uint32_t i = 0; i < schema.size(); ++i) {
    const gmap::EmbeddingDecl& decl = schema[EmbeddingId{i}];
    if (decl.derivation && !in_motion[i]) sources.embeddings[i] = ValueSource::gathered();
    if (decl.role == gmap::EmbeddingRole::Parameter) sources.embeddings[i] = ValueSource::missing();
  }
  // Motion holds velocities even if the store has none.
  if (velocity) sources.embeddings[types::index(*velocity)] = ValueSource::gathered();
  for (const ActiveInteraction& interaction : active)
    for (const ParameterBinding& parameter : interaction.parameters)
      sources.embeddings[types::index(parameter.embedding)] = source_of(parameter);
  return sources;
}

/// Loads last: then the sum of all internal forces on a vertex is how the sum of all begins.
std::vector<ActiveInteraction> with_loads_last(const State& state,
                                               std::vector<ActiveInteraction> active) {
  std::stable_partition(active.begin(), active.end(), [&](const ActiveInteraction& one) {
    return !state.program.interaction_bodies[one.interaction].external;
  });
  return active;
}

}  // namespace

ForceContext::ForceContext(const State& of, std::vector<ActiveInteraction> interactions)
    : state(of),
      active(with_loads_last(of, std::move(interactions))),
      position(find_position(of)),
      velocity(of.program.schema.find("velocity")),
      in_motion(moving_values(of, active, position, velocity)),
      sources(all_sources(of, active, velocity, in_motion)),
      world{of.program.schema, of.map, of.store, position} {}

}  // namespace gmsim::engine
