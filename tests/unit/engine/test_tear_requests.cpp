// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/tear_requests.h"

using namespace gmsim;
using engine::TearRequest;

namespace {

TearRequest request(std::uint32_t hook, double value, double threshold = 1, std::uint32_t pairing = 0) {
  TearRequest result;
  result.pairing = pairing;
  result.hook = gmap::DartId{hook};
  result.value = value;
  result.threshold = threshold;
  return result;
}

std::vector<std::uint32_t> hooks(const std::vector<TearRequest>& requests) {
  std::vector<std::uint32_t> result;
  for (const TearRequest& r : requests) result.push_back(types::index(r.hook));
  return result;
}

}  // namespace

TEST_CASE("requests go by value over threshold, whatever order they come in") {
  std::vector<TearRequest> all = {request(3, 2, 1), request(1, 3, 1), request(2, 8, 2),
                                  request(7, 2.5, 1)};
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(all.begin(), all.end(), random);
    engine::order_requests(all);
    CHECK(hooks(all) == std::vector<std::uint32_t>{2, 1, 7, 3});
  }
}

TEST_CASE("values that differ in their last digits are ties, and go by dart") {
  std::vector<TearRequest> all = {request(9, 2), request(4, 2 * (1 - 1e-12)),
                                  request(6, 2 * (1 + 1e-12)), request(1, 1.5)};
  engine::order_requests(all);
  CHECK(hooks(all) == std::vector<std::uint32_t>{4, 6, 9, 1});
}

TEST_CASE("at_most keeps the strongest and whatever ties with the last of them") {
  std::vector<TearRequest> all = {request(1, 5), request(2, 3), request(3, 3 * (1 + 1e-13)),
                                  request(4, 3 * (1 - 1e-13)), request(5, 2)};
  engine::choose_strongest(all, 2);
  CHECK(hooks(all) == std::vector<std::uint32_t>{1, 2, 3, 4});
  engine::choose_strongest(all, 1);
  CHECK(hooks(all) == std::vector<std::uint32_t>{1});
  engine::choose_strongest(all, 0);
  CHECK(all.empty());
}
