// SPDX-License-Identifier: MIT
#include "check/checked_rule.h"

#include <algorithm>

namespace gmsim::check {
namespace {

template <class T>
const T* find_named(const std::vector<T>& items, std::string_view name) {
  const auto found = std::ranges::find(items, name, &T::name);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::optional<NodeIndex> Pattern::find(const std::string& name) const {
  const auto found = std::ranges::find(nodes, name, &PatternNode::name);
  if (found == nodes.end()) return std::nullopt;
  return static_cast<NodeIndex>(found - nodes.begin());
}

const Rule* RuleLibrary::find_rule(std::string_view name) const { return find_named(rules, name); }
const Operation* RuleLibrary::find_operation(std::string_view name) const {
  return find_named(operations, name);
}
const Interaction* RuleLibrary::find_interaction(std::string_view name) const {
  return find_named(interactions, name);
}
const Criterion* RuleLibrary::find_criterion(std::string_view name) const {
  return find_named(criteria, name);
}
const Family* RuleLibrary::find_family(std::string_view name) const {
  return find_named(families, name);
}
std::optional<OrbitType> RuleLibrary::find_orbit(std::string_view name) const {
  const OrbitName* found = find_named(orbits, name);
  return found ? std::optional(found->orbit) : std::nullopt;
}

}  // namespace gmsim::check
