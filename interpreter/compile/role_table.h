// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "compile/specialise.h"

namespace gmsim::compile {

/// The orbits of one match, numbered in order of first appearance.
class RoleTable {
 public:
  explicit RoleTable(const World& world) : world_(world) {}

  void clear();
  /// The number of the orbit of `type` that holds `dart`.
  std::uint32_t role(OrbitType type, DartId dart);
  [[nodiscard]] const std::vector<Role>& roles() const { return roles_; }
  [[nodiscard]] std::vector<Role> take() { return std::exchange(roles_, {}); }

 private:
  struct Stamp {
    std::uint32_t epoch = 0;
    std::uint32_t role = 0;
  };
  static constexpr std::size_t kTypes = std::size_t{1} << (types::kMaxDimension + 1);

  const World& world_;
  std::vector<Role> roles_;
  std::uint32_t epoch_ = 1;
  std::array<std::vector<Stamp>, kTypes> stamps_;  // by row, or by smallest dart without an index
};

}  // namespace gmsim::compile
