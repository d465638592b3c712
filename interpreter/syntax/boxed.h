// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

namespace gmsim::syntax {

/// A large value on its way through the parser, whose stack has room for the largest of its values
/// in every place: boxing the few large ones keeps it small. Only to be read once it has a value.
template <class T>
class Boxed {
 public:
  Boxed() = default;
  // Implicit, so that actions read alike for boxed and other values.
  Boxed(T value) : value_(std::make_unique<T>(std::move(value))) {}  // NOLINT
  operator T() && { return std::move(*value_); }                     // NOLINT

 private:
  std::unique_ptr<T> value_;
};

}  // namespace gmsim::syntax
