// SPDX-License-Identifier: MIT
#include "scene/run_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "support/check.h"

extern char** environ;

namespace gmsim::scene {

namespace {

constexpr std::size_t kMostOutput = 64 * 1024;

class SpawnActions {
 public:
  explicit SpawnActions(int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// Reads until the other end closes; what is too much is read and dropped, so that the process is
/// never blocked.
std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t got = read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    const std::size_t room = kMostOutput - text.size();
    text.append(buffer.data(), std::min(static_cast<std::size_t>(got), room));
  }
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

std::optional<ProcessResult> run_process(const std::vector<std::string>& arguments) {
  GMSIM_CHECK(!arguments.empty(), "a process needs a program");
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  std::vector<char*> pointers;
  for (const std::string& argument : arguments)
    pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  pid_t process = 0;
  const int error = posix_spawnp(&process, pointers[0], SpawnActions(pipe_ends[1]).get(), nullptr,
                                 pointers.data(), environ);
  close(pipe_ends[1]);
  ProcessResult result;
  if (error == 0) {
    result.output = read_all(pipe_ends[0]);
    result.exit_code = wait_for(process);
  }
  close(pipe_ends[0]);
  if (error != 0) return std::nullopt;
  return result;
}

}  // namespace gmsim::scene
