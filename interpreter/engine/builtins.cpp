// SPDX-License-Identifier: MIT
#include "engine/builtins.h"

#include <array>

namespace gmsim::engine {

BuiltinFunction builtin_function(types::Builtin function) {
  static constexpr std::array kFunctions = {
#define BUILTIN(id, name, signatures, units, doc) &run_builtin<types::Builtin::id>,
#include "types/builtins.def"
#undef BUILTIN
  };
  return kFunctions[static_cast<std::size_t>(function)];
}

}  // namespace gmsim::engine
