#pragma once
// Processor time of the calling thread, for the times of `--report`.

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

}  // namespace lamina
