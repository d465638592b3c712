// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "check/checked_rule.h"
#include "support/tiny_map.h"

/// Random rules and random changes of given ones, for the checker's promise.
namespace gmsim::tests {

struct Mutant {
  check::Rule rule;
  std::string how;  ///< the changes made, "drop link, relocate labels"
};

/// One to three random changes. Some keep a sound rule sound (another position for a link, a
/// label entry written out as nodes, another name), most break it.
[[nodiscard]] Mutant mutate(const check::Rule& rule, Random& random);

/// A rule made of thin air: a few nodes with random labels and links.
[[nodiscard]] check::Rule random_rule(int dimension, Random& random);

}  // namespace gmsim::tests
