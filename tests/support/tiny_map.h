// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace gmsim::tests {

using Random = std::mt19937_64;
/// A number below `bound`.
inline int below(Random& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}
inline bool chance(Random& random, double probability) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53 < probability;
}

inline constexpr int kNone = -1;

/// A generalized map as bare tables, for oracles: links[d][i] is alpha_i(d), or kNone.
struct TinyMap {
  int dimension = 2;
  std::vector<std::array<int, 4>> links;
  std::vector<bool> dead;

  [[nodiscard]] int size() const { return static_cast<int>(links.size()); }
  int add_dart();
  void link(int i, int a, int b);
};

/// The axioms: every alpha_i is an involution of the living darts, and alpha_i alpha_j one for
/// i + 2 <= j. Empty, or what is wrong first.
[[nodiscard]] std::string flaw(const TinyMap& map);

/// One line a dart: "3: 2 3 7 3".
[[nodiscard]] std::string to_string(const TinyMap& map);

/// Involutions of which some pairs commute, defined in part and completed at random without ever
/// identifying two elements. Generalized maps are such tables, and so are the rows of a match.
class PartialTable {
 public:
  PartialTable(int generators, std::vector<std::vector<bool>> commute)
      : generators_(generators), commute_(std::move(commute)) {}
  static PartialTable of_map(int dimension);

  int add();
  [[nodiscard]] int size() const { return static_cast<int>(to_.size()); }
  [[nodiscard]] int get(int generator, int element) const { return to_[element][generator]; }
  /// Defines a pair with all that follows from it; false, and nothing changed, when that
  /// contradicts what is defined.
  bool set(int generator, int a, int b);

  struct Style {
    double loop = 0.2;    ///< chance to leave an element fixed
    double join = 0.3;    ///< chance to link it to one that is there
    int soft_limit = 30;  ///< beyond this many elements, new ones only where nothing else works
  };
  /// Defines everything that is undefined; false when it grew out of hand.
  bool complete(Random& random, const Style& style);

  [[nodiscard]] TinyMap map(int dimension) const;

 private:
  struct Pair {
    int generator, a, b;
  };
  void follow(const Pair& pair, std::vector<Pair>& todo) const;
  bool define(const Pair& pair, std::vector<Pair>& trail);
  bool fill(int generator, int element, Random& random, const Style& style);

  int generators_;
  std::vector<std::vector<bool>> commute_;
  std::vector<std::array<int, 4>> to_;
};

/// A connected or scattered map of random shape, degenerate ones included.
[[nodiscard]] TinyMap random_tiny_map(int dimension, Random& random);

}  // namespace gmsim::tests
