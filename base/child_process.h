#pragma once
// Work in a process of its own, so that what crashes there ends nothing else.
//
// The child is a copy of this process (fork), with one thread, and gives back
// bytes through a pipe. It dies with the thread that made it. What a library
// does to a process as a whole, to its locale, its environment, its handlers,
// stays in there.
//
// It may use what this process may, but its standard streams lead nowhere. It
// has the limits that this process has now, and what it takes is counted
// (memory_of_children()). Where operator new finds no memory it ends: libraries
// that hide a lack of memory would go on with half of their work.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include <sys/types.h>

namespace lamina {

// The child's end of the pipe.
class ChildOutput {
 public:
  explicit ChildOutput(int pipe) : pipe_(pipe) {}
  // Ends the child where nobody reads.
  void write(const void* bytes, std::size_t size) const;
  int descriptor() const { return pipe_; }

 private:
  int pipe_;
};

// How a child ended that did not end by itself.
enum class ChildFault { kNone, kCrashed, kOutOfTime, kOutOfMemory, kKilled };

class ChildProcess {
 public:
  // Starts the child, which calls `work` and ends.
  //
  // most_seconds  of processor time, or fewer where this process may take fewer
  // throws        Error where the system grants no process, or no pipe to it;
  //               std::bad_alloc
  ChildProcess(const std::function<void(const ChildOutput&)>& work,
               unsigned most_seconds);
  // Ends it.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Reads so many bytes of its output; false if it ended before.
  bool read(void* bytes, std::size_t size) const;

  // Can be read, or is at its end, when the child has written or ended.
  int descriptor() const { return pipe_; }

  // How long it may work [s of processor time].
  unsigned most_seconds() const { return most_seconds_; }

  // Waits until it has ended. To be called once.
  ChildFault wait();

 private:
  class SharedPage;

  std::unique_ptr<SharedPage> page_;
  unsigned most_seconds_;
  pid_t process_ = -1;  // -1: it has ended
  int pipe_ = -1;
};

// Memory that the children of this process take [bytes], beyond what they share
// with it since they were made.
std::uint64_t memory_of_children();

// Processor time that children took which have ended [s]: those of this
// process, and those that this thread has waited for.
double seconds_of_children();
double thread_seconds_of_children();

// The memory that this process takes now [bytes]; 0: unknown.
std::uint64_t resident_memory();

// The address space that this process may write to: what limits on data count
// [bytes]; 0: unknown.
std::uint64_t writable_memory();

}  // namespace lamina
