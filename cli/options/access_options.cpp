#include "cli/options/access_options.h"

#include "base/diagnostic.h"
#include "cli/command.h"

namespace lamina::cli {

void add_access_options(CLI::App& app, FileAccess::Limits& limits) {
  CLI::Option* const root = app.add_option("--root", limits.root);
  root->type_name("folder");
  // An empty name, as of a variable that is not set, must not mean "no root".
  root->check([](const std::string& folder) {
    return folder.empty() ? "a folder was expected, not ''" : "";
  });
  app.add_option("--allow-read", limits.readable)
      ->type_name("folder")
      ->needs(root)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--no-import", limits.refuses_data);
  // One looks at folders for as long as it runs, the other runs a program that
  // knows no root.
  for (const char* name : {"--watch", "--against"}) {
    if (CLI::Option* const option = app.get_option_no_throw(name)) {
      root->excludes(option);
    }
  }
}

FileAccess make_file_access(const FileAccess::Limits& limits) {
  try {
    return FileAccess(limits);
  } catch (const AccessError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace lamina::cli
