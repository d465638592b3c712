// SPDX-License-Identifier: MIT
#include "engine/value_programs.h"

#include "compile/compile_values.h"

namespace gmsim::engine {

const compile::ValueProgram& ValuePrograms::find(const compile::Rule& rule) {
  if (columns_ != state_.store.column_count()) {
    programs_.clear();
    last_rule_ = nullptr;
    columns_ = state_.store.column_count();
  }
  if (last_rule_ == &rule) return *last_;
  auto found = programs_.find(&rule);
  if (found == programs_.end()) {
    const gmap::EmbeddingSchema& schema = state_.program.schema;
    std::vector<bool> in_use(schema.size());
    for (const EmbeddingId id : state_.store.embeddings()) in_use[types::index(id)] = true;
    found = programs_.emplace(&rule, compile::compile_values(rule, schema, in_use)).first;
  }
  last_rule_ = &rule;
  last_ = &found->second;
  return *last_;
}

}  // namespace gmsim::engine
