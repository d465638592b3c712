// SPDX-License-Identifier: MIT
#include "engine/frame.h"

#include <algorithm>

namespace gmsim::engine {

void Frame::reset(std::uint32_t slots) {
  for (const types::Slot slot : used_) cell(slot) = Cell{};
  used_.clear();
  if (cells_.size() < slots) cells_.resize(slots);
  if (!collections_.empty()) collections_.clear();
  arena_.release({});
}

void Frame::set(types::Slot slot, types::DartId dart) {
  Cell& target = use(slot);
  target.kind = Kind::Dart;
  target.dart = dart;
}

void Frame::set(types::Slot slot, std::span<const double> numbers) {
  Cell& target = use(slot);
  if (target.numbers == nullptr || target.count != numbers.size()) {
    target.numbers = arena_.allocate(numbers.size());
    target.count = static_cast<std::uint32_t>(numbers.size());
  }
  target.kind = Kind::Numbers;
  std::copy(numbers.begin(), numbers.end(), target.numbers);
}

void Frame::set(types::Slot slot, std::vector<types::DartId> darts) {
  Cell& target = use(slot);
  if (target.darts == nullptr) target.darts = &collections_.emplace_back();
  target.kind = Kind::Darts;
  *target.darts = std::move(darts);
}

void Frame::set(types::Slot slot, const types::Value& value) {
  switch (value.type.kind) {
    case types::ValueKind::Dart:
      return set(slot, value.dart);
    case types::ValueKind::Darts:
      return set(slot, value.darts);
    default:
      return set(slot, value.data);
  }
}

}  // namespace gmsim::engine
