// SPDX-License-Identifier: MIT
// Timing for benchmark programs: medians over interleaved repetitions.
#pragma once

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <vector>

namespace gmsim::bench {

/// Seconds of processor time that a call takes in this thread: other programs on the machine do not
/// count.
template <class Work>
double seconds(Work&& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Makes the allocator keep what is freed, so that after a first repetition jobs run in memory that
/// the process owns: a page fault costs more than the work on a page, on both sides of a
/// comparison.
inline void keep_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

/// Keeps the compiler from dropping a computation whose result nobody reads.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace gmsim::bench
