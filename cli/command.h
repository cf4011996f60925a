#pragma once
// A command of the program, such as `lamina inspect`. Each has a file in
// cli/commands, with its options, its help and what it does.

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include <CLI/App.hpp>

#include "base/file/output_file.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

inline constexpr int kDone = 0;
inline constexpr int kFault = 1;  // of the design or of a file
inline constexpr int kUsageFault = 2;

// Options that are good each, but not together or not for this output.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message, int status = kUsageFault)
      : std::runtime_error(message), status_(status) {}

  int status() const { return status_; }

 private:
  int status_;
};

class Command {
 public:
  Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  virtual ~Command() = default;

  virtual std::string_view help() const = 0;

  // Binds options and positional words of `app` to this command, which
  // outlives it. What reads them throws CLI::ParseError.
  virtual void add_options(CLI::App& app) = 0;

  // Called when all words have been read: completes the options and throws
  // UsageError where they do not go together.
  virtual void check() {}

  // Returns the exit status. Faults have been shown.
  // stack  bytes of the thread that calls
  virtual int run(TemporaryFiles& temporary_files, std::size_t stack,
                  ProcessWatch& watch) = 0;
};

}  // namespace lamina::cli
