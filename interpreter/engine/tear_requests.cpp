// SPDX-License-Identifier: MIT
#include "engine/tear_requests.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace gmsim::engine {

namespace {

auto place(const TearRequest& request) {
  return std::tuple(types::index(request.hook), request.node, request.pairing);
}

/// Sorts by decreasing ratio; runs whose neighbours differ by less than kTie are one tie, sorted by
/// place.
void sort_by_ratio(std::vector<TearRequest>& requests) {
  std::sort(requests.begin(), requests.end(), [](const TearRequest& a, const TearRequest& b) {
    return a.ratio() != b.ratio() ? a.ratio() > b.ratio() : place(a) < place(b);
  });
  for (auto first = requests.begin(); first != requests.end();) {
    auto last = first + 1;
    while (last != requests.end() && (last - 1)->ratio() - last->ratio() <= kTie * (last - 1)->ratio())
      ++last;
    std::sort(first, last, [](const TearRequest& a, const TearRequest& b) {
      return place(a) < place(b);
    });
    first = last;
  }
}

}  // namespace

void choose_strongest(std::vector<TearRequest>& requests, std::optional<std::uint32_t> at_most) {
  if (at_most == 0u) requests.clear();
  if (at_most && requests.size() > *at_most) {
    // The weakest that is taken, whatever its place among its ties.
    std::vector<double> ratios;
    for (const TearRequest& request : requests) ratios.push_back(request.ratio());
    std::nth_element(ratios.begin(), ratios.begin() + (*at_most - 1), ratios.end(), std::greater<>());
    const double weakest = ratios[*at_most - 1];
    std::erase_if(requests, [&](const TearRequest& request) {
      return request.ratio() < weakest * (1 - kTie);
    });
  }
  sort_by_ratio(requests);
}

void order_requests(std::vector<TearRequest>& requests) { sort_by_ratio(requests); }

}  // namespace gmsim::engine
