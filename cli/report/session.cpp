#include "cli/report/session.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file/open_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/process/exit_status.h"
#include "cli/process/process_watch.h"
#include "cli/process/streams.h"

namespace lamina::cli {
namespace {

// Recursion of a design's functions ends here, long before memory does.
constexpr std::size_t kEvaluationStack = std::size_t{128} << 20;

bool are_equal(const Note& a, const Note& b) {
  return a.message == b.message && a.range.source == b.range.source &&
         a.range.begin == b.range.begin;
}

// Endless recursion has as many equal notes as the trace is long: one of them
// is shown, with their number.
Diagnostic with_folded_notes(const Diagnostic& diagnostic) {
  Diagnostic folded = diagnostic;
  folded.notes.clear();
  const std::vector<Note>& notes = diagnostic.notes;
  for (auto first = notes.begin(); first != notes.end();) {
    const auto last = std::find_if_not(first, notes.end(), [&](const Note& n) {
      return are_equal(n, *first);
    });
    Note& note = folded.notes.emplace_back(*first);
    if (last - first > 1) {
      note.message += fmt::format(" ({} times)", last - first);
    }
    first = last;
  }
  return folded;
}

bool ends_run(const Diagnostic& diagnostic,
              const compiler::Compilation& compilation) {
  return diagnostic.severity == Severity::kWarning &&
         (compilation.request.design.has_hard_warnings ||
          compilation.is_strict());
}

}  // namespace

Session::Session(const compiler::Request& request, bool is_quiet,
                 const Context& context, Inbox* inbox)
    : terminal(is_quiet, inbox),
      compilation(request, context.temporary_files,
                  [this](const Diagnostic& d) {
                    terminal.show(d, ends_run(d, compilation));
                  }) {
  compilation.evaluation_stack = std::min(context.stack / 2, kEvaluationStack);
  compilation.on_pass = [this](std::string_view pass) {
    pass.empty() ? terminal.progress().erase() : terminal.progress().say(pass);
  };
  compilation.on_progress = [this](std::uint64_t done, std::uint64_t all) {
    ProgressLine& line = terminal.progress();
    if (done == 0) line.begin(all, "layers");
    if (done < all) line.show(done);
    if (done >= all) line.erase();
  };
}

int Session::run(const std::function<int()>& work) {
  return run_caught(terminal, {&compilation.diagnostics}, work);
}

void report_skipped(compiler::Compilation& compilation,
                    const slicer::LayerFileFacts& facts) {
  const std::string left_out = slicer::left_out_text(facts);
  if (left_out.empty()) return;
  compilation.diagnostics.own_remark(
      {}, fmt::format("left out of '{}': {}", compilation.request.design.path,
                      left_out));
}

int run_caught(Terminal& terminal, const std::vector<const Diagnostics*>& shown,
               const std::function<int()>& work) {
  const auto show = [&](const std::string& words) {
    terminal.show({Severity::kError, {}, words});
  };
  try {
    return work();
  } catch (const InternalError& error) {
    show(fmt::format("internal error, please report: {}", error.what()));
  } catch (const ReaderGone&) {
    return kFault;
  } catch (const RequestError& error) {
    terminal.show(error.diagnostic());
    return kUsageFault;
  } catch (const Error& error) {
    const bool is_shown =
        std::ranges::any_of(shown, [&](const Diagnostics* messages) {
          return compiler::is_among(*messages, error.diagnostic());
        });
    if (!is_shown) terminal.show(error.diagnostic());
  } catch (const std::bad_alloc&) {
    show(out_of_memory_text());
  } catch (const std::exception& error) {
    show(fmt::format("internal error, please report: {}", error.what()));
  }
  return kFault;
}

Terminal::Terminal(bool is_quiet, Inbox* inbox)
    : is_quiet_(is_quiet),
      inbox_(inbox),
      progress_(!is_quiet && (inbox == nullptr || inbox->has_progress)) {}

Terminal::~Terminal() { finish(); }

void Terminal::show(const Diagnostic& diagnostic, bool ends_run) {
  const bool is_loud = diagnostic.severity == Severity::kError || ends_run;
  if (is_quiet_ && !is_loud) return;
  std::string text = caret_text(with_folded_notes(diagnostic));
  if (text.empty()) return;
  if (inbox_ != nullptr && inbox_->first_error.empty() &&
      diagnostic.severity == Severity::kError) {
    inbox_->first_error = diagnostic.message;
  }
  if (diagnostic.severity == Severity::kEcho) {
    if (echo_count_ > 0 && text == last_echo_) {
      ++echo_count_;
      return;
    }
    end_echoes();
    write(text);
    last_echo_ = std::move(text);
    echo_count_ = 1;
    return;
  }
  end_echoes();
  if (++counts_[text] == 1) write(text);
}

void Terminal::say(std::string_view line) {
  if (is_quiet_) return;
  end_echoes();
  write(fmt::format("{}\n", line));
}

void Terminal::finish() {
  progress_.erase();
  end_echoes();
  for (const auto& [text, count] : counts_) {
    if (count == 1) continue;
    write(fmt::format("{} ({} times in all)\n",
                      std::string_view(text).substr(0, text.find('\n')),
                      count));
  }
  counts_.clear();
}

void Terminal::end_echoes() {
  if (echo_count_ > 1) write(fmt::format("  ({} times)\n", echo_count_));
  echo_count_ = 0;
}

void Terminal::write(std::string_view words) {
  const std::string clean = without_controls(words);
  const std::string_view text = clean;
  if (inbox_ != nullptr) {
    // Where the message itself begins with the place in the prefix, that is
    // enough.
    std::string_view place = inbox_->prefix;
    place.remove_suffix(std::min<std::size_t>(place.size(), 1));
    if (place.empty() || !text.starts_with(place)) {
      inbox_->text += inbox_->prefix;
    }
    // Further lines begin with a name that may look like another row's prefix.
    for (std::size_t i = 0; i < text.size(); ++i) {
      inbox_->text += text[i];
      if (text[i] == '\n' && i + 1 < text.size()) inbox_->text += "  ";
    }
    return;
  }
  progress_.erase();
  print_messages(text);
}

}  // namespace lamina::cli
