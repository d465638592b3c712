// SPDX-License-Identifier: MIT
#include "compile/walk_program.h"

#include <algorithm>
#include <utility>

#include "gmap/orbit_walk.h"

namespace gmsim::compile {

namespace {

/// A longer walk is no faster than looking at the expressions.
constexpr std::uint32_t kMostSteps = 192;

}  // namespace

void WalkProgram::walk(const World& world, std::span<const DartId> node_darts) {
  darts_.resize(node_darts.size() + steps.size());
  std::copy(node_darts.begin(), node_darts.end(), darts_.begin());
  DartId* end = darts_.data() + node_darts.size();
  for (const Step& step : steps) *end++ = world.map.alpha(step.dimension, darts_[step.from]);
}

bool WalkProgram::meet_orbits(std::vector<Role>& roles) const {
  for (const OrbitTest& test : orbit_tests)
    if ((test.index->row(darts_[test.a]) == test.index->row(darts_[test.b])) != test.same)
      return false;
  roles.clear();
  for (const Visit& visit : visits) {
    const Role role{visit.type, darts_[visit.walk], visit.index->row(darts_[visit.walk])};
    if (visit.role < roles.size()) {
      if (roles[visit.role].row != role.row) return false;
      continue;
    }
    for (const Role& earlier : roles)
      if (earlier.row == role.row && earlier.type == role.type) return false;
    roles.push_back(role);
  }
  return true;
}

bool WalkProgram::find_roles(const World& world, std::span<const DartId> node_darts,
                             std::vector<Role>& roles) {
  walk(world, node_darts);
  return meet_orbits(roles);
}

bool WalkProgram::run(const World& world, std::span<const DartId> node_darts, MatchRoles& out) {
  walk(world, node_darts);
  for (const Test& test : tests)
    if (!holds(test)) return false;
  if (!meet_orbits(out.roles)) return false;
  for (const Presence& presence : presences)
    if (!world.store.column(presence.embedding).has(out.roles[presence.role].row)) return false;
  out.targets.clear();
  for (const std::uint32_t walk : targets) out.targets.push_back(darts_[walk]);
  out.atomic.clear();
  for (const ForceList& list : lists) {
    const std::size_t before = out.atomic.size();
    world.atomic_forces->list(list.type, darts_[list.walk], out.atomic);
    if (out.atomic.size() != before + list.count) return false;
  }
  return true;
}

void WalkProgram::list_dependences(const World& world, std::vector<Dependence>& out) const {
  out.clear();
  // Both ends of a link that changes have changed.
  for (const Step& step : steps)
    out.push_back({darts_[step.from], links(OrbitType{step.dimension})});
  for (const OrbitTest& test : orbit_tests)
    for (const std::uint32_t walk : {test.a, test.b})
      out.push_back({darts_[walk], row_of(test.index->type())});
  for (const Visit& visit : visits) out.push_back({darts_[visit.walk], row_of(visit.type)});
  for (const ForceList& list : lists)
    gmap::for_each_dart(world.map, list.type, darts_[list.walk], [&](DartId d) {
      out.push_back({d, links(list.type) | kForceList});
    });
}

bool WalkProgram::holds(const Test& test) const {
  const DartId a = darts_[test.a], b = darts_[test.b];
  switch (test.kind) {
    case Test::Kind::Same: return a == b;
    case Test::Kind::Different: return a != b;
    case Test::Kind::Older: return a < b;
  }
  return false;
}

void WalkTrace::start(std::uint32_t nodes, bool record) {
  program_ = {};
  program_.nodes = nodes;
  straight_ = record;
}

bool WalkTrace::known(std::uint32_t walk) {
  straight_ = straight_ && walk != kNoWalk;
  return straight_;
}

std::uint32_t WalkTrace::follow(std::uint32_t from, int dimension) {
  if (!straight_ || from == kNoWalk) return kNoWalk;
  auto& steps = program_.steps;
  const auto step = std::find_if(steps.begin(), steps.end(), [&](const WalkProgram::Step& s) {
    return s.from == from && s.dimension == dimension;
  });
  const auto number = static_cast<std::uint32_t>(step - steps.begin());
  if (number >= kMostSteps) {
    spoil();
    return kNoWalk;
  }
  if (step == steps.end()) steps.push_back({from, static_cast<std::uint8_t>(dimension)});
  return program_.nodes + number;
}

void WalkTrace::test(std::uint32_t a, std::uint32_t b, bool same) {
  if (known(a) && known(b))
    program_.tests.push_back(
        {a, b, same ? WalkProgram::Test::Kind::Same : WalkProgram::Test::Kind::Different});
}

void WalkTrace::test_orbit(const gmap::OrbitIndex& index, std::uint32_t a, std::uint32_t b,
                           bool same) {
  if (known(a) && known(b)) program_.orbit_tests.push_back({&index, a, b, same});
}

void WalkTrace::older(std::uint32_t a, std::uint32_t b) {
  if (known(a) && known(b)) program_.tests.push_back({a, b, WalkProgram::Test::Kind::Older});
}

void WalkTrace::visit(OrbitType type, std::uint32_t walk, std::uint32_t role,
                      const gmap::OrbitIndex* index) {
  straight_ = straight_ && index != nullptr;
  if (!known(walk)) return;
  const bool seen = std::any_of(program_.visits.begin(), program_.visits.end(),
                                [&](const WalkProgram::Visit& visit) {
                                  return visit.type == type && visit.walk == walk;
                                });
  if (!seen) program_.visits.push_back({type, walk, role, index});
}

void WalkTrace::require(EmbeddingId embedding, std::uint32_t role) {
  if (!straight_) return;
  const bool seen = std::any_of(program_.presences.begin(), program_.presences.end(),
                                [&](const WalkProgram::Presence& presence) {
                                  return presence.embedding == embedding && presence.role == role;
                                });
  if (!seen) program_.presences.push_back({embedding, role});
}

void WalkTrace::target(std::uint32_t walk) {
  if (known(walk)) program_.targets.push_back(walk);
}

void WalkTrace::list(OrbitType type, std::uint32_t walk, std::uint32_t count) {
  if (known(walk)) program_.lists.push_back({type, walk, count});
}

std::optional<WalkProgram> WalkTrace::take() {
  if (!straight_) return std::nullopt;
  return std::move(program_);
}

}  // namespace gmsim::compile
