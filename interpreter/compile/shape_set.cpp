// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "compile/specialise.h"
#include "compile/symbolic_walker.h"
#include "compile/walk_program.h"

namespace gmsim::compile {

namespace {

/// Walks tried before a match is looked at in full: those of a regular mesh, whose elements have
/// numbered their darts in a few different orders.
constexpr std::size_t kMostFastWays = 12;

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
    way.walks.list_dependences(world_, out.walked);
    out.everywhere = false;
    out.way = static_cast<std::uint8_t>(&way - fast_.data());
    return way.shape;
  }
  out.way = MatchRoles::kNoWay;
  specialiser_.walker_->record_walks(fast_.size() < kMostFastWays);
  if (!shapes_.empty()) {
    if (!specialiser_.trace(nodes, out)) return std::nullopt;
    if (const auto known = by_key_.find(out.key); known != by_key_.end()) {
      add_fast_way(known->second);
      return known->second;
    }
  }
  auto shape = std::make_unique<Shape>();
  if (!specialiser_.build(nodes, out, *shape)) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(shapes_.size());
  by_key_.emplace(out.key, number);
  shapes_.push_back(std::move(shape));
  add_fast_way(number);
  return number;
}

bool ShapeSet::follow(std::uint8_t way, std::span<const DartId> nodes, std::vector<Role>& roles) {
  return fast_[way].walks.find_roles(world_, nodes, roles);
}

void ShapeSet::add_fast_way(std::uint32_t shape) {
  auto walks = specialiser_.walker_->trace().take();
  if (walks && fast_.size() < kMostFastWays) fast_.push_back({std::move(*walks), shape});
}

}  // namespace gmsim::compile
