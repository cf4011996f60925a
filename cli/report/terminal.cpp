#include "cli/report/terminal.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace lamina::cli {
namespace {

// Endless recursion has as many equal notes as the trace is long: one is
// shown, with their number.
Diagnostic with_folded_notes(const Diagnostic& diagnostic) {
  Diagnostic folded = diagnostic;
  folded.notes.clear();
  std::size_t count = 0;
  for (std::size_t i = 0; i < diagnostic.notes.size(); ++i) {
    const Note& note = diagnostic.notes[i];
    ++count;
    const bool is_last = i + 1 == diagnostic.notes.size();
    if (!is_last && diagnostic.notes[i + 1].message == note.message &&
        diagnostic.notes[i + 1].range.source == note.range.source &&
        diagnostic.notes[i + 1].range.begin == note.range.begin) {
      continue;
    }
    folded.notes.push_back(note);
    if (count > 1) {
      folded.notes.back().message += fmt::format(" ({} times)", count);
    }
    count = 0;
  }
  return folded;
}

}  // namespace

Terminal::Terminal(bool is_quiet, Inbox* inbox)
    : is_quiet_(is_quiet),
      inbox_(inbox),
      progress_(!is_quiet && (inbox == nullptr || inbox->has_progress)) {}

Terminal::~Terminal() { finish(); }

void Terminal::show(const Diagnostic& diagnostic) {
  if (is_quiet_ && diagnostic.severity != Severity::kError) return;
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

void Terminal::write(std::string_view text) {
  if (inbox_ != nullptr) {
    // Where the message itself begins with the place in the prefix, that is
    // enough.
    std::string_view place = inbox_->prefix;
    place.remove_suffix(std::min<std::size_t>(place.size(), 1));
    if (place.empty() || !text.starts_with(place)) {
      inbox_->text += inbox_->prefix;
    }
    inbox_->text += text;
    return;
  }
  progress_.erase();
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace lamina::cli
