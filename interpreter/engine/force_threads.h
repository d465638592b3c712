// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace gmsim::engine {

/// Threads that share numbered tasks. Which thread does which task is left to chance, so tasks must
/// not depend on each other and each has to write places of its own. After some work the threads
/// stay awake for a short while, because the next stage of a step follows at once.
class ForceThreads {
 public:
  /// `count` threads, the caller's included.
  explicit ForceThreads(unsigned count);
  ~ForceThreads();
  ForceThreads(const ForceThreads&) = delete;
  ForceThreads& operator=(const ForceThreads&) = delete;

  [[nodiscard]] unsigned count() const { return static_cast<unsigned>(workers_.size()) + 1; }

  /// work(task, worker) for each task; worker < count(). With `alone` the caller does all of it.
  template <typename Work>
  void run(std::uint32_t tasks, bool alone, const Work& work) {
    if (alone || workers_.empty() || tasks < 2) {
      for (std::uint32_t task = 0; task < tasks; ++task) work(task, 0);
      return;
    }
    share(tasks, [](const void* context, std::uint32_t task, unsigned worker) {
      (*static_cast<const Work*>(context))(task, worker);
    }, &work);
  }

 private:
  using Call = void (*)(const void*, std::uint32_t, unsigned);

  void share(std::uint32_t tasks, Call call, const void* context);
  void serve(unsigned worker);
  void take_tasks(unsigned worker);
  [[nodiscard]] std::uint32_t wait_for_work(std::uint32_t seen) const;

  std::vector<std::thread> workers_;
  std::atomic<std::uint32_t> round_{0};    // goes up when there is work
  std::atomic<std::uint32_t> next_{0};     // task
  std::atomic<std::uint32_t> running_{0};  // workers that are not done with this round
  std::atomic<bool> stop_{false};
  std::uint32_t tasks_ = 0;
  Call call_ = nullptr;
  const void* context_ = nullptr;
};

}  // namespace gmsim::engine
