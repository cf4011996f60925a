#pragma once
// A user's own defaults of options: lines "name = value" in
// ~/.config/lamina/config, for all designs, and in lamina.conf beside a design,
// for those of its folder. '#' begins a comment.
//
//     printer = elegoo-mars-3
//     layer   = 0.03
//
// What the command line says counts before lamina.conf, and that before the
// other. No setting names a file to write: a stranger's folder may have a
// lamina.conf. Under --root neither file is read.

#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "cli/options/option_list.h"

namespace lamina::cli {

struct UserSetting {
  std::string_view name;  // "printer", "output", …
  std::string value;      // paths of profiles are those of the file's folder
  std::string place;      // "/home/me/.config/lamina/config:1"
};

// The files that may hold settings, what counts first last. The second one
// stands beside the design; there is none where `design` is empty.
std::vector<std::string> settings_files(const std::string& design);

// The settings of these files, in their order.
//
// throws  FileError where a line is none of them
std::vector<UserSetting> read_user_settings(
    const std::vector<std::string>& files, const FileAccess& access);

// The first word of the command line that is no option and no value of one: the
// design. Empty where there is none.
std::string first_file(const OptionList& options);

// Gives options that were not given the settings' values. Those of other
// commands, and of outputs that are no layers, are passed over.
//
// throws  FileError where a value is faulty
void apply_user_settings(const std::vector<UserSetting>& settings,
                         OptionList& options);

}  // namespace lamina::cli
