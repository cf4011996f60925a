#include "cli/process/large_stack.h"

#include <utility>

#include <sys/mman.h>

namespace lamina::cli {

LargeStack::LargeStack() {
  for (size_ = kLargestSize; size_ >= kSmallestSize; size_ /= 2) {
    begin_ =
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (begin_ == MAP_FAILED) continue;
    ::mprotect(begin_, kGuardSize, PROT_NONE);
    return;
  }
}

LargeStack::~LargeStack() {
  if (begin_ != MAP_FAILED) ::munmap(begin_, size_);
}

bool LargeStack::start(std::function<void()> work) {
  if (begin_ == MAP_FAILED) return false;
  work_ = std::move(work);
  const auto run = [](void* function) -> void* {
    (*static_cast<std::function<void()>*>(function))();
    return nullptr;
  };
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  const bool is_started =
      ::pthread_attr_setstack(&attributes, begin_, size_) == 0 &&
      ::pthread_create(&thread_, &attributes, run, &work_) == 0;
  ::pthread_attr_destroy(&attributes);
  return is_started;
}

}  // namespace lamina::cli
