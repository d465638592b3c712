// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

namespace gmsim::syntax {

/// One level of nesting, counted for as long as the guard lives. The parser keeps it on its stack
/// as the value of a symbol, so the count is right whatever error recovery drops.
class DepthGuard {
 public:
  DepthGuard() = default;
  explicit DepthGuard(int& depth) : depth_(&depth) { ++depth; }
  DepthGuard(DepthGuard&& other) noexcept : depth_(std::exchange(other.depth_, nullptr)) {}
  DepthGuard& operator=(DepthGuard&& other) noexcept {
    std::swap(depth_, other.depth_);
    return *this;
  }
  ~DepthGuard() {
    if (depth_ != nullptr) --*depth_;
  }

 private:
  int* depth_ = nullptr;
};

}  // namespace gmsim::syntax
