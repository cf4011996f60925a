#pragma once
// A design that is being worked on, in a process of its own.
//
// The process reads and parses the design once. For each choice it makes a copy
// of itself (fork), which goes on from there: what parameters do not reach is
// not done again, and whatever a run does, takes or breaks ends with it. A new
// choice ends the run of the one before at once, wherever it is.

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "base/child_process.h"
#include "base/file/open_file.h"
#include "base/file/temporary_files.h"
#include "compiler/request.h"
#include "serve/studio/choice.h"

namespace lamina::studio {

// Runs of different lanes do not end each other.
enum class Lane : char { kShown, kFile };
inline constexpr std::size_t kLanes = 2;

class DesignProcess {
 public:
  struct Options {
    compiler::Request request;  // of the studio, with the design's path
    Names names;
    TemporaryFiles& temporary_files;
    std::size_t evaluation_stack = 0;  // bytes
    unsigned most_seconds = 0;         // of processor time, for one run
    // Whether each run reads the design anew. It sends the same.
    bool reads_anew = false;
  };

  // Throws as ChildProcess does.
  explicit DesignProcess(const Options& options);

  // Starts the run of a choice, and ends that of the same lane.
  //
  // body    the page's request, which read_choice() has taken
  // is_source  whether it is that of POST /source
  // file    gets the bytes of an output; -1: there is none
  // returns the pipe of frames (frames.h), which ends with the run; not open
  //         where the process has ended
  OpenFile start(Lane lane, const std::string& body, bool is_source = false,
                 int file = -1);

  // Ends the run of a lane, if it has one.
  void end(Lane lane);

 private:
  OpenFile commands_;
  std::unique_ptr<ChildProcess> process_;
};

}  // namespace lamina::studio
