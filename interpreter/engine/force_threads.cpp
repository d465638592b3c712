// SPDX-License-Identifier: MIT
#include "engine/force_threads.h"

namespace gmsim::engine {

namespace {

constexpr int kSpins = 2000;  // looks before a thread lets others go first
constexpr int kYields = 50;   // and before it goes to sleep

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

ForceThreads::ForceThreads(unsigned count) {
  for (unsigned worker = 1; worker < count; ++worker)
    workers_.emplace_back([this, worker] { serve(worker); });
}

ForceThreads::~ForceThreads() {
  stop_.store(true);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

std::uint32_t ForceThreads::wait_for_work(std::uint32_t seen) const {
  for (int yields = 0; yields < kYields; ++yields) {
    for (int spins = 0; spins < kSpins; ++spins) {
      const std::uint32_t round = round_.load(std::memory_order_acquire);
      if (round != seen) return round;
      relax();
    }
    std::this_thread::yield();
  }
  round_.wait(seen, std::memory_order_acquire);
  return round_.load(std::memory_order_acquire);
}

void ForceThreads::serve(unsigned worker) {
  std::uint32_t seen = 0;
  while (true) {
    seen = wait_for_work(seen);
    if (stop_.load()) return;
    take_tasks(worker);
    running_.fetch_sub(1, std::memory_order_release);
  }
}

void ForceThreads::take_tasks(unsigned worker) {
  for (std::uint32_t task; (task = next_.fetch_add(1, std::memory_order_relaxed)) < tasks_;)
    call_(context_, task, worker);
}

void ForceThreads::share(std::uint32_t tasks, Call call, const void* context) {
  tasks_ = tasks;
  call_ = call;
  context_ = context;
  next_.store(0, std::memory_order_relaxed);
  running_.store(static_cast<std::uint32_t>(workers_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  take_tasks(0);
  for (int spins = 0; running_.load(std::memory_order_acquire) != 0; ++spins) {
    relax();
    if (spins > kSpins) std::this_thread::yield();
  }
}

}  // namespace gmsim::engine
