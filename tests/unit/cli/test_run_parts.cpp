// SPDX-License-Identifier: MIT
// The clock of frames, JSON text, and the line of a terminal.
#include <doctest/doctest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <random>

#include "cli/frame_clock.h"
#include "cli/json_text.h"
#include "cli/run_log.h"

using namespace gmsim::cli;

TEST_CASE("every time is due once, at the first step end at or after it") {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<> uniform(0, 1);
    const double end = 1 + uniform(random), every = seed % 5 == 0 ? 0 : 0.01 + 0.2 * uniform(random);
    std::vector<double> at;
    while (uniform(random) < 0.7) at.push_back(end * uniform(random));
    std::vector<double> due = at;
    for (int k = 0; every > 0 && k * every <= end; ++k) due.push_back(k * every);
    due.push_back(end);

    FrameClock clock(0, every, at, end);
    double previous = -INFINITY;
    for (double time = 0; previous < end; time = std::min(end, time + 0.03 * uniform(random))) {
      const bool wanted = std::any_of(due.begin(), due.end(), [&](double moment) {
        return moment > previous && moment <= time;
      });
      CHECK(clock.is_due(time, 0) == wanted);
      clock.pass(time, 0);
      previous = time;
    }
    CHECK(clock.next() == INFINITY);
  }
}

TEST_CASE("times that rounding moved behind a step end are met by it") {
  FrameClock clock(0, 0.1, {}, 1);
  double time = 0;
  int frames = 0;
  for (int step = 0; step <= 1000; ++step, time += 1e-3) {
    if (!clock.is_due(time, 1e-9)) continue;
    CHECK(step % 100 == 0);
    clock.pass(time, 1e-9);
    ++frames;
  }
  CHECK(frames == 11);
}

TEST_CASE("JSON keeps numbers and text") {
  const std::string text = "a \"quoted\" \\ line\nnext\ttab \x01 größer";
  JsonObject object;
  object.add("text", text).add("third", 1.0 / 3).add("tiny", 5e-324).add("big", 1e300);
  object.add("yes", true).add("count", std::uint64_t{1} << 63).add("never", INFINITY);
  const YAML::Node read = YAML::Load(object.text());
  CHECK(read["text"].as<std::string>() == text);
  CHECK(read["third"].as<double>() == 1.0 / 3);
  CHECK(read["big"].as<double>() == 1e300);
  CHECK(read["yes"].as<bool>());
  CHECK(read["count"].as<std::uint64_t>() == std::uint64_t{1} << 63);
  CHECK(read["never"].IsNull());
  CHECK(JsonObject().text() == "{}");
}

TEST_CASE("the line of a terminal fits it and says how far the run is") {
  RunProgress progress;
  progress.duration = 2;
  progress.time = 0.5;
  progress.steps = 5000;
  progress.wall = 10;
  progress.max_elongation = 1.25;
  for (std::size_t width = 1; width < 200; ++width)
    CHECK(progress_line(progress, width).size() <= width);
  const std::string line = progress_line(progress, 200);
  for (const char* part : {"[#####---------------]", "25.0 %", "500 steps/s", "0.05x real time",
                           "ETA 0:30", "max elongation 1.25"})
    CHECK_MESSAGE(line.find(part) != std::string::npos, part);
  CHECK(clock_text(3723) == "1:02:03");
  CHECK(clock_text(INFINITY) == "?");
  CHECK_FALSE(progress_line({}, 80).empty());
}
