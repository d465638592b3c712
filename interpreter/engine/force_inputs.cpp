// SPDX-License-Identifier: MIT
#include "engine/force_inputs.h"

#include <algorithm>

#include "engine/force_watch.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace ir = compile::ir;

namespace {

/// Doubles of each input, 0 of one that nothing depends on.
std::vector<std::uint32_t> input_widths(const compile::Shape& shape) {
  std::vector<std::uint32_t> widths(shape.graph.inputs().size(), 0);
  const std::vector<bool> used = ir::reachable(shape.graph, shape.roots());
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    const ir::Node& node = shape.graph[ir::NodeId{i}];
    if (used[i] && node.op == ir::Op::Input)
      widths[node.aux] = types::component_count({node.type});
  }
  return widths;
}

}  // namespace

ShapeInputs::ShapeInputs(const ForceContext& context, const compile::Shape& shape)
    : context_(context), draws_(shape.draws) {
  own_count_ = static_cast<std::uint32_t>(draws_.size());
  const std::vector<std::uint32_t> widths = input_widths(shape);
  for (std::size_t k = 0; k < widths.size(); ++k)
    origins_.push_back(widths[k] == 0 ? InputOrigin{.width = 0}
                                      : origin(shape, shape.graph.inputs()[k], widths[k]));
  for (const compile::Draw& draw : draws_) own_roles_.push_back(draw.role);
  for (const Derived& derived : derived_) own_roles_.push_back(derived.role);
  for (const InputOrigin& origin : origins_)
    if (origin.width > 0 && origin.kind == InputOrigin::Kind::Column)
      column_roles_.push_back(origin.role);
  support::sort_once(own_roles_);
  support::sort_once(column_roles_);
}

InputOrigin ShapeInputs::origin(const compile::Shape& shape, const ir::Input& input,
                                std::uint32_t width) {
  using Kind = InputOrigin::Kind;
  switch (input.source) {
    case ir::Input::Source::Embedding: return embedding_origin(input, width);
    case ir::Input::Source::MatchValue: return {.kind = Kind::Own, .offset = input.role};
    case ir::Input::Source::ForceOn:
      return {.kind = Kind::ForceOn, .role = input.role, .offset = input.offset, .width = width,
              .embedding = {}, .orbit = shape.roles[input.role]};
    case ir::Input::Source::AtomicForce:  // columns of their own, behind those of the roles
      return {.kind = Kind::AtomicForce,
              .role = static_cast<std::uint32_t>(shape.roles.size()) + input.role,
              .width = width};
    case ir::Input::Source::Time: return {.kind = Kind::Time};
    case ir::Input::Source::Dt: return {.kind = Kind::Dt};
    case ir::Input::Source::Step: return {.kind = Kind::Step};
  }
  return {};
}

InputOrigin ShapeInputs::embedding_origin(const ir::Input& input, std::uint32_t width) {
  InputOrigin result{.role = input.role, .width = width, .embedding = input.embedding};
  if (input.embedding == context_.position) {
    result.kind = InputOrigin::Kind::Position;
  } else if (context_.velocity == input.embedding) {
    result.kind = InputOrigin::Kind::Velocity;
  } else if (context_.state.store.in_use(input.embedding)) {
    result.kind = InputOrigin::Kind::Column;
    result.offset = input.offset;
  } else {
    result.kind = InputOrigin::Kind::Own;
    result.offset = derived_at(input.embedding, input.role) + input.offset;
  }
  return result;
}

std::uint32_t ShapeInputs::derived_at(EmbeddingId embedding, std::uint32_t role) {
  const auto known = std::find_if(derived_.begin(), derived_.end(), [&](const Derived& derived) {
    return derived.embedding == embedding && derived.role == role;
  });
  if (known != derived_.end()) return known->offset;
  const std::uint32_t width =
      types::component_count(context_.state.program.schema[embedding].type);
  derived_.push_back({embedding, role, own_count_, width});
  own_count_ += width;
  return derived_.back().offset;
}

std::vector<std::uint32_t> ShapeInputs::own_widths() const {
  std::vector<std::uint32_t> widths(draws_.size(), 1);
  for (const Derived& derived : derived_) widths.push_back(derived.width);
  return widths;
}

bool ShapeInputs::own_stay_in_orbits() const {
  return std::all_of(derived_.begin(), derived_.end(), [&](const Derived& derived) {
    return stays_in_orbit(context_.state.program.schema, derived.embedding);
  });
}

std::optional<support::Diagnostic> ShapeInputs::read_own(TreeEvaluator& reader,
                                                         std::span<const compile::Role> roles,
                                                         std::vector<double>& out) const {
  const std::size_t begin = out.size();
  out.resize(begin + own_count_);
  const std::span<double> own = std::span(out).subspan(begin);
  for (std::size_t k = 0; k < draws_.size(); ++k) {
    const compile::Role& role = roles[draws_[k].role];
    own[k] = random_number(draws_[k].seed, context_.state, role.type, role.dart);
  }
  for (const Derived& derived : derived_) {
    const std::span<double> value = own.subspan(derived.offset, derived.width);
    if (!reader.read(derived.embedding, roles[derived.role].dart, value))
      return reader.take_failure().diagnostic;
  }
  return std::nullopt;
}

}  // namespace gmsim::engine
