#pragma once
// All commands of the program.

#include <array>
#include <memory>
#include <string_view>

#include "cli/commands/command.h"

namespace lamina::cli {

std::unique_ptr<Command> make_slice_command();
std::unique_ptr<Command> make_batch_command();
std::unique_ptr<Command> make_compare_command();
std::unique_ptr<Command> make_inspect_command();
std::unique_ptr<Command> make_view_command();

struct NamedCommand {
  std::string_view name;  // the first word of the command line
  std::unique_ptr<Command> (*make)();
};

// Where none of these comes first, the words are those of slicing a design.
inline constexpr std::array kNamedCommands = {
    NamedCommand{"batch", make_batch_command},
    NamedCommand{"compare", make_compare_command},
    NamedCommand{"inspect", make_inspect_command},
    NamedCommand{"view", make_view_command}};

}  // namespace lamina::cli
