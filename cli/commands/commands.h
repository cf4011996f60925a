#pragma once
// The commands of the program, such as `lamina inspect`. Each has a file in
// cli/commands with its options, its help and its work.

#include <array>
#include <memory>
#include <string_view>

#include "cli/options/option_list.h"
#include "cli/process/context.h"

namespace lamina::cli {

class Command {
 public:
  virtual ~Command() = default;

  virtual std::string_view help() const = 0;

  // What --help prints, if that is not all.
  virtual std::string_view short_help() const { return help(); }

  // Binds options and positional words to this command, which outlives the
  // list.
  virtual void add_options(OptionList& options) = 0;

  // Whether the user's settings are defaults of its options.
  virtual bool takes_settings() const { return false; }

  // Called when all words have been read: completes the options and throws
  // RequestError where they do not go together.
  virtual void check() {}

  // Returns the exit status. Faults have been shown.
  virtual int run(const Context& context) = 0;
};

std::unique_ptr<Command> make_slice_command();
std::unique_ptr<Command> make_batch_command();
std::unique_ptr<Command> make_check_command();
std::unique_ptr<Command> make_compare_command();
std::unique_ptr<Command> make_config_command();
std::unique_ptr<Command> make_inspect_command();
std::unique_ptr<Command> make_materials_command();
std::unique_ptr<Command> make_orient_command();
std::unique_ptr<Command> make_parts_command();
std::unique_ptr<Command> make_plate_command();
std::unique_ptr<Command> make_preflight_command();
std::unique_ptr<Command> make_printers_command();
std::unique_ptr<Command> make_serve_command();
std::unique_ptr<Command> make_sprue_command();
std::unique_ptr<Command> make_studio_command();
std::unique_ptr<Command> make_supports_command();
std::unique_ptr<Command> make_tree_command();
std::unique_ptr<Command> make_view_command();

struct NamedCommand {
  std::string_view name;  // the first word of the command line
  std::unique_ptr<Command> (*make)();
};

// Where none of these comes first, the words are those of slicing a design.
inline constexpr std::array kNamedCommands = {
    NamedCommand{"batch", make_batch_command},
    NamedCommand{"check", make_check_command},
    NamedCommand{"compare", make_compare_command},
    NamedCommand{"config", make_config_command},
    NamedCommand{"inspect", make_inspect_command},
    NamedCommand{"materials", make_materials_command},
    NamedCommand{"orient", make_orient_command},
    NamedCommand{"parts", make_parts_command},
    NamedCommand{"plate", make_plate_command},
    NamedCommand{"preflight", make_preflight_command},
    NamedCommand{"printers", make_printers_command},
    NamedCommand{"serve", make_serve_command},
    NamedCommand{"sprue", make_sprue_command},
    NamedCommand{"studio", make_studio_command},
    NamedCommand{"supports", make_supports_command},
    NamedCommand{"tree", make_tree_command},
    NamedCommand{"view", make_view_command}};

}  // namespace lamina::cli
