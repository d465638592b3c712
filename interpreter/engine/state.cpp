// SPDX-License-Identifier: MIT
#include "engine/state.h"

namespace gmsim::engine {

State::State(const compile::Program& compiled, gmap::GMap initial)
    : program(compiled), map(std::move(initial)), store(program.schema, map) {}

void State::use_data() {
  for (std::size_t i = 0; i < program.schema.size(); ++i) {
    const auto id = static_cast<EmbeddingId>(i);
    const gmap::EmbeddingDecl& decl = program.schema[id];
    const bool stored = decl.kind != gmap::EmbeddingKind::Derived;
    if (stored && decl.role == gmap::EmbeddingRole::Data) store.use(id);
  }
}

}  // namespace gmsim::engine
