#pragma once
// A design that is being worked on, in a process of its own.
//
// The process reads and parses the design once. For each run it makes a copy of
// itself (fork), which goes on from there: what parameters do not reach is not
// done again, and whatever a run does, takes or breaks ends with it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/child_process.h"
#include "base/file/open_file.h"
#include "base/file/temporary_files.h"
#include "compiler/compilation.h"

namespace lamina::serve {

// What a run is asked for.
struct Command {
  char kind = 0;     // that the work knows
  std::string body;  // likewise, at most kMostBody bytes
};
inline constexpr std::size_t kMostBody = 128 << 10;

// What is done in these processes.
class DesignWork {
 public:
  virtual ~DesignWork() = default;

  // In the process of the design, before all runs.
  //
  // design  as it has been read; reading again fails where that failed
  // output  pipe of frames (frames.h), DesignProcess::output()
  virtual void take_design(compiler::Compilation& design, int output) = 0;

  // In the process of a run. What it throws ends the run as a crash does.
  //
  // output  pipe of frames, Run::output
  virtual void run(compiler::Compilation& design, const Command& command,
                   int output) = 0;

  // In the process of the design: writes what there is to say of a run that did
  // not end by itself.
  virtual void report_fault(const Command& command, ChildFault fault,
                            int output) = 0;
};

// Hands a run's compilation to its work: the design as it was read, or one that
// will read it, where supports, sprues or a search for a direction change or
// repeat the reading.
//
// reads_anew  whether it is read anew in any case
void go_on_from_read(compiler::Compilation& design, compiler::Request request,
                     bool reads_anew,
                     const std::function<void(compiler::Compilation&)>& work);

// Says how a run ended that did not end by itself.
std::string words_of(ChildFault fault);

class DesignProcess {
 public:
  struct Options {
    compiler::Request request;
    DesignWork& work;  // only the processes use these two
    TemporaryFiles& temporary_files;
    std::size_t evaluation_stack = 0;  // bytes
    unsigned most_seconds = 0;         // of processor time, for one run
    // Of memory, beyond what the caller has, for one run and its design; 0: as
    // much as the caller may take.
    std::uint64_t most_bytes = 0;
  };

  struct Run {
    std::uint64_t number = 0;
    // The pipe of frames, which ends with the run; not open where the process
    // has ended.
    OpenFile output;
  };

  // Throws as ChildProcess does.
  explicit DesignProcess(const Options& options);

  // Starts a run.
  //
  // file  its standard output; -1: that leads nowhere
  Run start(const Command& command, int file = -1);

  // Ends a run, if it has not ended.
  void end(std::uint64_t run);

  // Pipe of what take_design() writes; it ends with the process.
  int output() const { return output_.descriptor(); }

 private:
  OpenFile commands_;
  OpenFile output_;
  std::uint64_t last_run_ = 0;
  std::unique_ptr<ChildProcess> process_;
};

}  // namespace lamina::serve
