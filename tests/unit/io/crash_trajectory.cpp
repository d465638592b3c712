// SPDX-License-Identifier: MIT
// Runs that do not end well: every frame that was reported as written must come back.
//
//   crash_trajectory kills COUNT SEED FOLDER    SIGKILL at random moments
//   crash_trajectory limits COUNT SEED FOLDER   writes that fail at random sizes of the file
//   crash_trajectory snapshots COUNT SEED FOLDER   copies of runs that go on meanwhile
//   crash_trajectory child PATH SEED POINTS FRAMES LIMIT
//
// SEED 0: a fresh one, printed. The recovered files stay in FOLDER (check_crashes.py shows them to
// VTK).
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "io/recover.h"
#include "unit/io/synthetic_run.h"

extern char** environ;

using namespace gmsim;
using test::SyntheticRun;

namespace {

constexpr std::int64_t kFrames = 60;
constexpr std::int64_t kForever = 1000000;
constexpr int kWriteFailed = 3;

SyntheticRun run_of(std::uint32_t seed, std::size_t points) {
  return SyntheticRun({.seed = seed,
                       .dimension = 2 + static_cast<int>(seed % 2),
                       .polyhedra = seed % 4 == 3,
                       .points = points});
}

/// Says that a frame is safe, before anything else can happen.
void acknowledge(char letter) {
  if (write(STDOUT_FILENO, &letter, 1) != 1) _exit(9);
}

int child(const std::filesystem::path& path, const SyntheticRun& run, std::int64_t frames,
          rlim_t limit) {
  if (limit > 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit size{limit, limit};
    setrlimit(RLIMIT_FSIZE, &size);
  }
  support::Diagnostics diagnostics;
  const auto writer = io::TrajectoryWriter::create(path, run.description(), {}, diagnostics);
  if (!writer) return kWriteFailed;
  for (std::int64_t i = 0; i < frames; ++i) {
    if (!run.write(*writer, i, diagnostics)) return kWriteFailed;
    acknowledge('f');
  }
  return writer->close("", diagnostics) ? 0 : kWriteFailed;
}

/// A child with its acknowledgements.
class Child {
 public:
  Child(const std::vector<std::string>& arguments) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    std::vector<char*> pointers;
    for (const std::string& argument : arguments)
      pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    if (posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, pointers.data(), environ) != 0)
      std::abort();
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    output_ = ends[0];
  }
  ~Child() { close(output_); }

  /// Waits for `count` acknowledgements or the end of the child.
  void wait_for(std::int64_t count) {
    char letter;
    while (frames_ < count && read(output_, &letter, 1) == 1) ++frames_;
  }
  void kill() { ::kill(process_, SIGKILL); }
  /// The status of the ended child; counts the acknowledgements that are left.
  int finish() {
    wait_for(kForever);
    int status = 0;
    waitpid(process_, &status, 0);
    return status;
  }
  [[nodiscard]] std::int64_t frames() const { return frames_; }

 private:
  pid_t process_ = 0;
  int output_ = -1;
  std::int64_t frames_ = 0;
};

/// What is wrong with what the child left; empty when every acknowledged frame is there and right.
std::string check(const std::filesystem::path& path, const SyntheticRun& run,
                  std::int64_t acknowledged, std::int64_t* recovered) {
  support::Diagnostics diagnostics;
  *recovered = 0;
  if (std::filesystem::exists(io::part_path(path))) {
    const auto frames = io::recover(io::part_path(path), path, diagnostics);
    std::filesystem::remove(io::part_path(path));
    if (!frames)
      return acknowledged == 0 ? "" : "not recovered: " + diagnostics.all().front().message;
    *recovered = *frames;
  } else if (std::filesystem::exists(path)) {
    *recovered = kFrames;
  }
  if (*recovered < acknowledged)
    return fmt::format("{} frames, {} were reported", *recovered, acknowledged);
  if (*recovered == 0) return "";
  const auto reader = io::TrajectoryReader::open(path, diagnostics);
  return reader ? run.difference(*reader, *recovered) : diagnostics.all().front().message;
}

struct Trial {
  std::filesystem::path path;
  std::uint32_t seed;
  std::size_t points;

  [[nodiscard]] std::vector<std::string> arguments(std::uint64_t limit,
                                                   std::int64_t frames = kFrames) const {
    return {"crash_trajectory",     "child",
            path.string(),          std::to_string(seed),
            std::to_string(points), std::to_string(frames),
            std::to_string(limit)};
  }
};

void kill_somewhere(Child& child, std::mt19937& random) {
  child.wait_for(static_cast<std::int64_t>(random() % (kFrames + 1)));
  std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
  child.kill();
  child.finish();
}

/// The size of the file when nothing goes wrong.
std::uint64_t full_size(const Trial& trial) {
  Child child(trial.arguments(0));
  child.finish();
  const auto size = std::filesystem::file_size(trial.path);
  std::filesystem::remove(trial.path);
  return size;
}

/// Runs into a limit somewhere in the file; it must be noticed.
std::string fail_somewhere(const Trial& trial, std::mt19937& random, std::int64_t* frames) {
  const std::uint64_t size = full_size(trial);
  const std::uint64_t limit = 1 + random() % size;
  Child child(trial.arguments(limit));
  const int status = child.finish();
  *frames = child.frames();
  if (!WIFEXITED(status) || (WEXITSTATUS(status) != kWriteFailed && WEXITSTATUS(status) != 0)) {
    return fmt::format("limit {} of {}: the child ended with status {}", limit, size, status);
  }
  return "";
}

struct Snapshot {
  std::filesystem::path path;
  std::int64_t reported = 0;  ///< frames reported before it was taken
  std::int64_t frames = 0;    ///< frames in it
};

/// Copies of a run, taken while it goes on.
std::vector<Snapshot> take_snapshots(Child& child, const Trial& trial, int count,
                                     std::string& problem) {
  std::vector<Snapshot> snapshots;
  for (int i = 0; i < count; ++i) {
    child.wait_for(child.frames() + 3);
    Snapshot snapshot{trial.path.parent_path() / fmt::format("snapshot{}.vtkhdf", i),
                      child.frames()};
    support::Diagnostics diagnostics;
    const auto frames = io::recover(io::part_path(trial.path), snapshot.path, diagnostics);
    if (!frames) {
      problem = diagnostics.all().front().message;
      break;
    }
    snapshot.frames = *frames;
    snapshots.push_back(snapshot);
  }
  return snapshots;
}

/// Every snapshot must hold what had been reported before.
int snapshots(int count, std::uint32_t seed, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Trial trial{folder / "live.vtkhdf", seed, 100};
  std::filesystem::remove(io::part_path(trial.path));
  Child child(trial.arguments(0, kForever));
  std::string problem;
  const auto taken = take_snapshots(child, trial, count, problem);
  child.kill();
  child.finish();
  for (const Snapshot& snapshot : taken) {
    support::Diagnostics diagnostics;
    const auto reader = io::TrajectoryReader::open(snapshot.path, diagnostics);
    if (!problem.empty()) break;
    problem = snapshot.frames < snapshot.reported ? "frames are missing"
              : reader ? run_of(seed, trial.points).difference(*reader, snapshot.frames)
                       : diagnostics.all().front().message;
  }
  if (!problem.empty()) fmt::print(stderr, "FAILED: seed {}: {}\n", seed, problem);
  fmt::print("seed {}: {} snapshots of a run of {} frames\n", seed, taken.size(), child.frames());
  return problem.empty() ? 0 : 1;
}

int parent(bool kills, int count, std::uint32_t seed, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::mt19937 random(seed);
  int complete = 0, partial = 0, none = 0;
  for (int i = 0; i < count; ++i) {
    constexpr std::array<std::size_t, 3> kPoints = {30, 300, 1000};
    const Trial trial{folder / fmt::format("run{}.vtkhdf", i),
                      static_cast<std::uint32_t>(random() % 1000),
                      kPoints[random() % kPoints.size()]};
    std::filesystem::remove(trial.path);
    std::filesystem::remove(io::part_path(trial.path));
    std::int64_t acknowledged = 0, recovered = 0;
    std::string problem;
    if (kills) {
      Child child(trial.arguments(0));
      kill_somewhere(child, random);
      acknowledged = child.frames();
    } else {
      problem = fail_somewhere(trial, random, &acknowledged);
    }
    if (problem.empty())
      problem = check(trial.path, run_of(trial.seed, trial.points), acknowledged, &recovered);
    if (!problem.empty()) {
      fmt::print(stderr, "FAILED: seed {}, trial {} (run {}, {} points, {} frames reported): {}\n",
                 seed, i, trial.seed, trial.points, acknowledged, problem);
      return 1;
    }
    ++(recovered == kFrames ? complete : recovered > 0 ? partial : none);
  }
  fmt::print("seed {}: {} runs cut short and recovered, {} complete, {} without a frame\n", seed,
             partial, complete, none);
  return partial > 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() == 6 && words[0] == "child") {
    const auto seed = static_cast<std::uint32_t>(std::stoul(words[2]));
    return child(words[1], run_of(seed, std::stoul(words[3])), std::stol(words[4]),
                 std::stoul(words[5]));
  }
  const bool is_mode =
      !words.empty() && (words[0] == "kills" || words[0] == "limits" || words[0] == "snapshots");
  if (words.size() == 4 && is_mode) {
    auto seed = static_cast<std::uint32_t>(std::stoul(words[2]));
    if (seed == 0) seed = std::random_device{}();
    if (words[0] == "snapshots") return snapshots(std::stoi(words[1]), seed, words[3]);
    return parent(words[0] == "kills", std::stoi(words[1]), seed, words[3]);
  }
  fmt::print(stderr, "usage: crash_trajectory kills|limits|snapshots COUNT SEED FOLDER\n");
  return 2;
}
