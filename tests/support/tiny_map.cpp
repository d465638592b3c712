// SPDX-License-Identifier: MIT
#include "support/tiny_map.h"

#include <algorithm>
#include <cstdlib>

namespace gmsim::tests {

int TinyMap::add_dart() {
  links.push_back({kNone, kNone, kNone, kNone});
  dead.push_back(false);
  return size() - 1;
}

void TinyMap::link(int i, int a, int b) {
  links[a][i] = b;
  links[b][i] = a;
}

std::string flaw(const TinyMap& map) {
  const auto text = [](int i, int d) {
    return "alpha_" + std::to_string(i) + "(" + std::to_string(d) + ")";
  };
  for (int d = 0; d < map.size(); ++d) {
    if (map.dead[d]) continue;
    for (int i = 0; i <= map.dimension; ++i) {
      const int e = map.links[d][i];
      if (e == kNone || map.dead[e]) return text(i, d) + " leads nowhere";
      if (map.links[e][i] != d) return text(i, d) + " is not answered";
    }
  }
  for (int d = 0; d < map.size(); ++d) {
    if (map.dead[d]) continue;
    for (int i = 0; i <= map.dimension; ++i)
      for (int j = i + 2; j <= map.dimension; ++j)
        if (map.links[map.links[d][i]][j] != map.links[map.links[d][j]][i])
          return text(i, d) + " and " + text(j, d) + " do not commute";
  }
  return {};
}

std::string to_string(const TinyMap& map) {
  std::string text;
  for (int d = 0; d < map.size(); ++d) {
    if (map.dead[d]) continue;
    text += std::to_string(d) + ":";
    for (int i = 0; i <= map.dimension; ++i) text += " " + std::to_string(map.links[d][i]);
    text += "\n";
  }
  return text;
}

PartialTable PartialTable::of_map(int dimension) {
  std::vector<std::vector<bool>> commute(4, std::vector<bool>(4, false));
  for (int i = 0; i <= dimension; ++i)
    for (int j = 0; j <= dimension; ++j) commute[i][j] = std::abs(i - j) >= 2;
  return {dimension + 1, std::move(commute)};
}

int PartialTable::add() {
  to_.push_back({kNone, kNone, kNone, kNone});
  return size() - 1;
}

/// Appends the fourth sides of the squares over a pair that have three sides; of those that have
/// four, the opposite side, which may turn out to be defined otherwise.
void PartialTable::follow(const Pair& pair, std::vector<Pair>& todo) const {
  for (int h = 0; h < generators_; ++h) {
    if (!commute_[pair.generator][h]) continue;
    const int c = to_[pair.a][h], d = to_[pair.b][h];
    if (c != kNone && d != kNone) {
      todo.push_back({pair.generator, c, d});
    } else if (c != kNone && to_[c][pair.generator] != kNone) {
      todo.push_back({h, pair.b, to_[c][pair.generator]});
    } else if (d != kNone && to_[d][pair.generator] != kNone) {
      todo.push_back({h, pair.a, to_[d][pair.generator]});
    }
  }
}

bool PartialTable::define(const Pair& first, std::vector<Pair>& trail) {
  std::vector<Pair> todo{first};
  while (!todo.empty()) {
    const Pair pair = todo.back();
    todo.pop_back();
    int &a_to = to_[pair.a][pair.generator], &b_to = to_[pair.b][pair.generator];
    if (a_to == pair.b && b_to == pair.a) continue;
    if (a_to != kNone || b_to != kNone) return false;
    a_to = pair.b;
    b_to = pair.a;
    trail.push_back(pair);
    follow(pair, todo);
    if (pair.a != pair.b) follow({pair.generator, pair.b, pair.a}, todo);
  }
  return true;
}

bool PartialTable::set(int generator, int a, int b) {
  std::vector<Pair> trail;
  if (define({generator, a, b}, trail)) return true;
  for (const Pair& pair : trail) {
    to_[pair.a][pair.generator] = kNone;
    to_[pair.b][pair.generator] = kNone;
  }
  return false;
}

bool PartialTable::fill(int generator, int element, Random& random, const Style& style) {
  const bool full = size() >= style.soft_limit;
  const double dice = static_cast<double>(random() >> 11) * 0x1.0p-53;
  if ((dice < style.loop || (full && chance(random, 0.5))) && set(generator, element, element))
    return true;
  if (dice < style.loop + style.join || full) {
    // Some elements that lack the same link; not all, to bound the work.
    const int start = below(random, size());
    for (int k = 0, tried = 0; k < size() && tried < 6; ++k) {
      const int other = (start + k) % size();
      if (other == element || to_[other][generator] != kNone) continue;
      ++tried;
      if (set(generator, element, other)) return true;
    }
  }
  if (full && set(generator, element, element)) return true;
  return set(generator, element, add());
}

bool PartialTable::complete(Random& random, const Style& style) {
  for (int element = 0; element < size(); ++element) {
    if (size() > 12 * style.soft_limit + 200) return false;
    const int start = below(random, generators_);
    for (int k = 0; k < generators_; ++k) {
      const int generator = (start + k) % generators_;
      if (to_[element][generator] == kNone && !fill(generator, element, random, style))
        return false;
    }
  }
  return true;
}

TinyMap PartialTable::map(int dimension) const {
  TinyMap map;
  map.dimension = dimension;
  for (const std::array<int, 4>& links : to_) {
    map.links.push_back(links);
    map.dead.push_back(false);
  }
  return map;
}

TinyMap random_tiny_map(int dimension, Random& random) {
  while (true) {
    PartialTable table = PartialTable::of_map(dimension);
    const int seeds = 1 + below(random, 4);
    for (int k = 0; k < seeds; ++k) table.add();
    PartialTable::Style style;
    style.loop = 0.4 * static_cast<double>(below(random, 3));
    style.join = 0.25 * static_cast<double>(below(random, 3));
    style.soft_limit = 4 + below(random, 60);
    if (table.complete(random, style)) return table.map(dimension);
  }
}

}  // namespace gmsim::tests
