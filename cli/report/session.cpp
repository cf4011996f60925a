#include "cli/report/session.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "cli/process/exit_status.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {
namespace {

// Recursion of a design's functions ends here, long before memory does.
constexpr std::size_t kEvaluationStack = std::size_t{128} << 20;

// Whether it has been shown: some passes report what they throw.
bool is_reported(const Diagnostics& diagnostics, const Diagnostic& thrown) {
  const auto is_thrown = [&](const Diagnostic& diagnostic) {
    return diagnostic.message == thrown.message &&
           diagnostic.range.source == thrown.range.source &&
           diagnostic.range.begin == thrown.range.begin;
  };
  return std::any_of(diagnostics.all().begin(), diagnostics.all().end(),
                     is_thrown);
}

}  // namespace

Session::Session(const compiler::Request& request, bool is_quiet,
                 const Context& context, Inbox* inbox)
    : terminal(is_quiet, inbox),
      compilation(request, context.temporary_files,
                  [this](const Diagnostic& d) { terminal.show(d); }) {
  compilation.evaluation_stack = std::min(context.stack / 2, kEvaluationStack);
  compilation.on_progress = [this](std::uint64_t done, std::uint64_t all) {
    ProgressLine& line = terminal.progress();
    if (done == 0) line.begin(all, "layers");
    if (done < all) line.show(done);
    if (done >= all) line.erase();
  };
}

int Session::run(const std::function<int()>& work) {
  return run_caught(terminal, compilation.diagnostics, work);
}

int run_caught(Terminal& terminal, const Diagnostics& diagnostics,
               const std::function<int()>& work) {
  const auto show = [&](const std::string& words) {
    terminal.show({Severity::kError, {}, words});
  };
  try {
    return work();
  } catch (const InternalError& error) {
    show(fmt::format("internal error, please report: {}", error.what()));
  } catch (const Error& error) {
    if (!is_reported(diagnostics, error.diagnostic())) {
      terminal.show(error.diagnostic());
    }
  } catch (const std::bad_alloc&) {
    show(out_of_memory_text());
  } catch (const std::exception& error) {
    show(fmt::format("internal error, please report: {}", error.what()));
  }
  return kFault;
}

}  // namespace lamina::cli
