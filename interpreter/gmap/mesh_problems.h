// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// Things of a mesh that share one problem, named by number: one message for all of them.
class ProblemList {
 public:
  /// `what` heads the message: "points used by no cell".
  ProblemList(bool fatal, std::string what) : fatal_(fatal), what_(std::move(what)) {}

  /// `item` names the thing: "12", or "12 (point 3)".
  void add(std::string item) {
    if (++count_ <= kNamed) items_.push_back(std::move(item));
  }
  void add(std::size_t number) { add(std::to_string(number)); }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// Appends the message when there is anything to say.
  void report(std::vector<MeshProblem>& problems) const;

 private:
  static constexpr std::size_t kNamed = 10;
  bool fatal_;
  std::string what_;
  std::vector<std::string> items_;
  std::size_t count_ = 0;
};

/// "3-7-9"
[[nodiscard]] std::string join_numbers(const std::vector<std::uint32_t>& numbers,
                                       const char* separator);

/// Checks the cells of a mesh and returns the corners of all of them (as Mesh::cell_points) with
/// inverted solids turned round. Unusable when a problem is fatal.
[[nodiscard]] std::vector<std::uint32_t> check_cells(const Mesh& mesh,
                                                     std::vector<MeshProblem>& problems);

}  // namespace gmsim::gmap
