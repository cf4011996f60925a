#pragma once
// What a run may read and write, and the options that say so.

#include <CLI/App.hpp>

#include "base/file/file_access.h"

namespace lamina::cli {

// --root, --allow-read and --no-import, which all commands have. To be called
// when the command's own options are there: some do not go with --root.
void add_access_options(CLI::App& app, FileAccess::Limits& limits);

// Throws UsageError for what is no folder.
FileAccess make_file_access(const FileAccess::Limits& limits);

}  // namespace lamina::cli
