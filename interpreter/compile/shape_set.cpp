// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "compile/specialise.h"
#include "compile/symbolic_walker.h"
#include "compile/walk_program.h"

namespace gmsim::compile {

namespace {

/// Walks tried before a match is looked at in full: the shapes of an item in a regular mesh.
constexpr std::size_t kMostFastWays = 4;

}  // namespace

struct ShapeSet::FastWay {
  WalkProgram walks;
  std::uint32_t shape = 0;
};

std::size_t ShapeSet::KeyHash::operator()(const std::vector<std::uint32_t>& key) const {
  std::size_t hash = key.size();
  for (const std::uint32_t entry : key) hash ^= entry + 0x9e3779b97f4a7c15u + (hash << 6) + (hash >> 2);
  return hash;
}

ShapeSet::ShapeSet(const World& world, const ItemBody& body, Wanted wanted,
                   const ValueSources& sources)
    : world_(world), specialiser_(world, body, std::move(wanted), sources) {}
ShapeSet::~ShapeSet() = default;

std::optional<std::uint32_t> ShapeSet::classify(std::span<const DartId> nodes, MatchRoles& out) {
  for (FastWay& way : fast_) {
    if (!way.walks.run(world_, nodes, out)) continue;
    out.straight = true;
    out.walked = way.walks.darts();
    return way.shape;
  }
  const auto note_walks = [&](std::optional<WalkProgram>& walks) {
    MatchRoles again;
    out.straight = walks && walks->run(world_, nodes, again);
    out.walked = out.straight ? walks->darts() : std::vector<DartId>{};
  };
  if (!shapes_.empty()) {
    if (!specialiser_.trace(nodes, out)) return std::nullopt;
    if (const auto known = by_key_.find(out.key); known != by_key_.end()) {
      auto walks = specialiser_.walker_->trace().take();
      note_walks(walks);
      return known->second;
    }
  }
  auto shape = std::make_unique<Shape>();
  if (!specialiser_.build(nodes, out, *shape)) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(shapes_.size());
  by_key_.emplace(out.key, number);
  shapes_.push_back(std::move(shape));
  auto walks = specialiser_.walker_->trace().take();
  note_walks(walks);
  if (walks && fast_.size() < kMostFastWays) fast_.push_back({std::move(*walks), number});
  return number;
}

}  // namespace gmsim::compile
