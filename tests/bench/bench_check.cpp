// SPDX-License-Identifier: MIT
// How long a user waits before anything moves: to read the whole library (from its texts to checked
// rules in every dimension of the map, and to the plans of one), to load a scene (which needs the
// library in one dimension), and from the start of the process to the first step of the paper's cloth, its frame
// written. To be run from the top folder of the repository.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_timing.h"
#include "check/check.h"
#include "compile/compile.h"
#include "scene/scene.h"
#include "support/check.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

using namespace gmsim;
using namespace gmsim::bench;

namespace {

constexpr double kBar = 20.0;  // ms
constexpr double kReadAim = 5.0, kProcessAim = 10.0;
constexpr const char* kScene = "scenes/paper/fig14_cloth.yaml";

struct Times {
  std::vector<double> check, compile[3], library, scene;  // ms
};

void read_library(Times& times) {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  check::CheckedRules rules;
  const double checked =
      seconds([&] { rules = check::check_rules({}, {}, sources, diagnostics); });
  GMSIM_CHECK(!diagnostics.has_errors(), "the library has no errors");
  double slowest = 0.0;
  for (int n = 1; n <= 3; ++n) {
    const double compiled = seconds([&] { keep(compile::compile_program(rules.in(n))); });
    times.compile[n - 1].push_back(1e3 * compiled);
    slowest = std::max(slowest, compiled);
  }
  times.check.push_back(1e3 * checked);
  times.library.push_back(1e3 * (checked + slowest));
}

void read_scene(Times& times) {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  std::unique_ptr<scene::Scene> loaded;
  times.scene.push_back(1e3 * seconds([&] {
                          loaded = scene::load_scene(kScene, {.build = false}, sources, diagnostics);
                        }));
  GMSIM_CHECK(loaded != nullptr && !diagnostics.has_errors(), "the scene has no errors");
}

struct ProcessTimes {
  std::vector<double> first_step, whole, processor;  // ms
};

/// Reads what a program says to its end, and gives the moment at which it said `words`.
std::chrono::steady_clock::time_point read_to_end(int stream, std::string_view words) {
  std::chrono::steady_clock::time_point said{};
  std::string text;
  char buffer[4096];
  bool found = false;
  for (ssize_t count = 0; (count = read(stream, buffer, sizeof buffer)) > 0;) {
    if (found) continue;
    text.append(buffer, static_cast<std::size_t>(count));
    found = text.find(words) != std::string::npos;
    if (found) said = std::chrono::steady_clock::now();
  }
  GMSIM_CHECK(found, "gmsim reports its frames");
  return said;
}

/// Runs gmsim for one step, after which it writes a frame and says so.
void run_process(const std::filesystem::path& result, ProcessTimes& times) {
  // What the scene expects comes later than the first step.
  std::vector<std::string> words{GMSIM_PROGRAM, kScene,     "--json",  "--set", "duration=1e-3",
                                 "--set",       "expect=[]", "--force", "-o",   result.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  GMSIM_CHECK(pipe(ends) == 0, "a pipe can be made");
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&streams, ends[0]);
  posix_spawn_file_actions_addclose(&streams, ends[1]);
  posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  GMSIM_CHECK(
      posix_spawn(&child, words[0].c_str(), &streams, nullptr, arguments.data(), environ) == 0,
      "gmsim can be started");
  close(ends[1]);
  const auto stepped = read_to_end(ends[0], "\"frame\": 1,");
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const auto end = std::chrono::steady_clock::now();
  close(ends[0]);
  posix_spawn_file_actions_destroy(&streams);
  GMSIM_CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0, "gmsim runs the scene");
  const auto since_start = [&](std::chrono::steady_clock::time_point moment) {
    return std::chrono::duration<double, std::milli>(moment - start).count();
  };
  const auto milliseconds = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  times.first_step.push_back(since_start(stepped));
  times.whole.push_back(since_start(end));
  times.processor.push_back(milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime));
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

void row(std::string_view name, const std::vector<double>& values) {
  fmt::print("  {:<48}{:>8.2f}{:>9.2f}\n", name, least(values), median(values));
}
void row(std::string_view name, const std::vector<double>& values, double aim) {
  fmt::print("  {:<48}{:>8.2f}{:>9.2f}   bar {:.0f} {}, aim {:.0f} {}\n", name, least(values),
             median(values), kBar, least(values) <= kBar ? "pass" : "MISS", aim,
             least(values) <= aim ? "reached" : "not reached");
}

}  // namespace

int main(int argc, char** argv) {
  bool must_pass = false;
  int repetitions = 25;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--check") {
      must_pass = true;
    } else if (argument == "--repetitions" && i + 1 < argc) {
      repetitions = std::max(1, std::atoi(argv[++i]));
    } else {
      fmt::print("usage: bench_check [--check] [--repetitions N]\n"
                 "  --check  exit with 1 when a bar is missed\n");
      return argument == "--help" || argument == "-h" ? 0 : 2;
    }
  }
  Times times;
  ProcessTimes process;
  const std::filesystem::path result =
      std::filesystem::temp_directory_path() / fmt::format("bench_check_{}.vtkhdf", getpid());
  for (int k = 0; k < repetitions; ++k) {
    read_library(times);
    read_scene(times);
    run_process(result, process);
  }
  std::filesystem::remove(result);
  fmt::print("ms, {} repetitions {:>36}{:>9}\n", repetitions, "least", "median");
  row("the library: parse and check, all dimensions", times.check);
  for (int n = 1; n <= 3; ++n) {
    row(fmt::format("the library: compile, dimension {}", n), times.compile[n - 1]);
  }
  row("the library: parse, check and compile", times.library, kReadAim);
  row("library and scene: parse, check and compile", times.scene, kReadAim);
  row("10 x 10 cloth: process start to first step written", process.first_step, kProcessAim);
  row("10 x 10 cloth: the whole process, one step", process.whole);
  row("10 x 10 cloth: processor time of that", process.processor);
  const bool passed = least(times.library) <= kBar && least(times.scene) <= kBar &&
                      least(process.first_step) <= kBar;
  return must_pass && !passed ? 1 : 0;
}
