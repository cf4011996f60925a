#include "base/memory_end.h"

#include <new>

namespace lamina {

namespace {
thread_local bool has_memory_ended = false;
}  // namespace

void note_memory_end() {
  has_memory_ended = true;
  throw std::bad_alloc();
}

void watch_memory(const std::function<void()>& work) {
  has_memory_ended = false;
  work();
  if (has_memory_ended) throw std::bad_alloc();
}

}  // namespace lamina
