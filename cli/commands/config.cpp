// lamina config: the user's own settings.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "cli/commands/commands.h"
#include "cli/options/user_settings.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/session.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kConfigHelp =
    R"(Usage: lamina config [DESIGN]

Shows your settings, and where each comes from. They are defaults of options, in
lines such as

    printer = elegoo-mars-3
    layer   = 0.03
    output  = goo           # the format, where -o does not say it

in ~/.config/lamina/config, and in lamina.conf beside a design for the designs
of that folder. Settings are: printer, material, metal, price, layer, output,
scale, min-feature, compensate and fail-on. The command line counts before
lamina.conf, and that before ~/.config/lamina/config. Under --root neither is
read.

  -h, --help  print this help
)";

class ConfigCommand : public Command {
 public:
  std::string_view help() const override { return kConfigHelp; }

  void add_options(OptionList& options) override {
    options.word("design", design_);
  }

  int run(const Context& context) override {
    Terminal terminal(false);
    return run_caught(terminal, {}, [&] {
      refuse_if(context.file_access().is_confined(),
                "under --root there are no settings");
      // Without a design: of one in this folder.
      const std::vector<std::string> files =
          settings_files(design_.empty() ? "design.scad" : design_);
      std::string text;
      for (const UserSetting& setting :
           read_user_settings(files, context.file_access())) {
        text += fmt::format("{:<11} = {:<24}  # {}\n", setting.name,
                            setting.value, display_path(setting.place));
      }
      if (text.empty()) {
        text = "no settings; they would be in:\n";
        for (const std::string& file : files) {
          text += fmt::format("  {}\n", display_path(file));
        }
      }
      print_out(text);
      return kDone;
    });
  }

 private:
  std::string design_;
};

}  // namespace

std::unique_ptr<Command> make_config_command() {
  return std::make_unique<ConfigCommand>();
}

}  // namespace lamina::cli
