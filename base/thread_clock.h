#pragma once
// Processor time of the calling thread, for the times of `--report`.
//
// To ask for it is a system call, of 0.4 us. What is done for every layer is
// measured by the clock on the wall, which takes a tenth of that, and gets its
// share of the processor time of all layers of a block.

#include <chrono>

#include <time.h>

namespace lamina {

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

// Runs `work` and returns the processor seconds that it took.
template <typename Work>
double measure_seconds(const Work& work) {
  const double begin = thread_seconds();
  work();
  return thread_seconds() - begin;
}

// Runs `work` and returns the seconds that pass on the wall.
template <typename Work>
double measure_wall_seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
      .count();
}

}  // namespace lamina
