// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>

#include "compile/value_program.h"
#include "engine/state.h"

namespace gmsim::engine {

/// The value programs of the rules that were applied, for the columns that are in use. Rules stay
/// where they are while this lives.
class ValuePrograms {
 public:
  explicit ValuePrograms(const State& state) : state_(state) {}

  /// Valid until columns are added.
  const compile::ValueProgram& find(const compile::Rule& rule);

 private:
  const State& state_;
  std::unordered_map<const compile::Rule*, compile::ValueProgram> programs_;
  std::size_t columns_ = 0;
  const compile::Rule* last_rule_ = nullptr;
  const compile::ValueProgram* last_ = nullptr;
};

}  // namespace gmsim::engine
