#pragma once
// A command of the program, such as `lamina inspect`. Each has a file in
// cli/commands, with its options, its help and what it does.

#include <string_view>

#include <CLI/App.hpp>

#include "cli/process/context.h"

namespace lamina::cli {

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
  virtual int run(const Context& context) = 0;
};

}  // namespace lamina::cli
