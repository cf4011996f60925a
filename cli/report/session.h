#pragma once
// A compilation whose messages and progress the user sees.

#include <functional>

#include "base/diagnostic.h"
#include "cli/process/context.h"
#include "cli/report/terminal.h"
#include "compiler/compilation.h"

namespace lamina::cli {

struct Session {
  // request  outlives the session
  // inbox    as of Terminal
  Session(const compiler::Request& request, bool is_quiet,
          const Context& context, Inbox* inbox = nullptr);

  // run_caught() with the session's own terminal and messages.
  int run(const std::function<int()>& work);

  Terminal terminal;
  compiler::Compilation compilation;
};

// Returns what `work` returns; where it throws, shows the message, unless it
// is among `diagnostics` and so has been shown, and returns kFault.
int run_caught(Terminal& terminal, const Diagnostics& diagnostics,
               const std::function<int()>& work);

}  // namespace lamina::cli
