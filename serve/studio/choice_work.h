#pragma once
// What the studio does in the processes of a design: runs of choices.

#include <optional>

#include "compiler/request.h"
#include "serve/run/design_process.h"
#include "serve/run/names.h"
#include "serve/studio/choice.h"
#include "serve/studio/events.h"

namespace lamina::studio {

// The kinds of commands. Their body is that of the page's request, which
// read_choice() has taken.
enum class Task : char {
  kShow = 's',    // POST /change
  kWrite = 'w',   // POST /output: the bytes go to standard output
  kSource = 'e',  // POST /source
};

class ChoiceWork : public serve::DesignWork {
 public:
  // base        of the studio, with the design's path
  // reads_anew  whether each run reads the design anew; it sends the same
  ChoiceWork(compiler::Request base, serve::Names names,
             bool reads_anew = false);

  void take_design(compiler::Compilation& design, int output) override;
  void run(compiler::Compilation& design, const serve::Command& command,
           int output) override;
  void report_fault(const serve::Command& command, ChildFault fault,
                    int output) override;

 private:
  compiler::Request base_;
  serve::Names names_;
  bool reads_anew_;
  std::optional<Form> form_;  // of the design, if it could be read
};

}  // namespace lamina::studio
