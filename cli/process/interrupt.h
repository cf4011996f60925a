#pragma once
// An interrupt of work that can end early with what it has.
//
// Ctrl-C ends the process, unless the work asks. The first question says that
// it will go on asking; from then on the first interrupt is the answer to these
// questions, and only the second one ends the process. SIGTERM is such an
// interrupt only for services. The thread that waits for signals writes the
// answer, any thread reads it.

#include <atomic>

namespace lamina::cli {

class Interrupt {
 public:
  // Whether the work should end now.
  bool asks_to_end() {
    is_heard_ = true;
    return is_asked_;
  }

  // The work has ended: the next interrupt ends the process.
  void stop_asking() { is_heard_ = false; }

  // From now on SIGTERM and SIGHUP ask as Ctrl-C does.
  void hear_termination() { hears_termination_ = true; }

  // Takes an interrupt. Returns whether the work ends by itself.
  //
  // is_termination  not by Ctrl-C
  bool take(bool is_termination) {
    return is_heard_ && (!is_termination || hears_termination_) &&
           !is_asked_.exchange(true);
  }

 private:
  std::atomic<bool> is_heard_ = false;
  std::atomic<bool> is_asked_ = false;
  std::atomic<bool> hears_termination_ = false;
};

}  // namespace lamina::cli
