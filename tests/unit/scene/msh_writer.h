// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gmsim::test {

/// A mesh as the tests want it in a Gmsh file.
struct MshContent {
  struct Cell {
    std::int32_t type;  ///< element type of Gmsh
    std::int32_t group;
    std::uint64_t tag;
    std::vector<std::uint32_t> corners;  ///< positions in `points`
  };
  struct Data {
    std::string name;
    std::uint32_t components;
    std::vector<std::uint64_t> tags;
    std::vector<double> values;
  };
  struct Group {
    int dimension;
    std::int32_t number;
    std::string name;
  };
  std::vector<std::array<double, 3>> points;
  std::vector<std::uint64_t> point_tags;
  std::vector<Cell> cells;
  std::vector<Group> groups;
  std::vector<Data> node_data, element_data;
};

/// One way to write it down.
struct MshForm {
  const char* name;
  const char* version;  ///< "1", "2.2" or "4.1"
  bool binary = false;
  bool swapped = false;
  int size_bytes = 8;
};

inline constexpr std::array kMshForms = {
    MshForm{"1 text", "1"},
    MshForm{"2.2 text", "2.2"},
    MshForm{"2.2 binary", "2.2", true},
    MshForm{"2.2 binary swapped", "2.2", true, true},
    MshForm{"4.1 text", "4.1"},
    MshForm{"4.1 binary", "4.1", true},
    MshForm{"4.1 binary swapped", "4.1", true, true},
    MshForm{"4.1 binary, sizes of 4 bytes", "4.1", true, false, 4},
};

[[nodiscard]] std::string write_msh(const MshContent& content, const MshForm& form);

}  // namespace gmsim::test
