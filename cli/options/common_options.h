#pragma once
// Options that all commands have: what the process may take, and which files it
// may use.

#include <string>

#include "base/file/file_access.h"
#include "cli/options/option_list.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

// Adds --help, --version, --max-time, --max-memory, --root, --allow-read and
// --no-import. To be called after the command has added its own options, some
// of which --root excludes. `limits` and `access` outlive `options`.
void add_common_options(OptionList& options, ProcessLimits& limits,
                        FileAccess::Limits& access);

// "500M", "2G", "1.5g", "800000k", "123456789" or "50%": K, M and G are powers
// of 1024. Throws RequestError for all other texts.
MemoryLimit parse_memory_limit(const std::string& text);

// Throws RequestError for what is not a folder.
FileAccess make_file_access(const FileAccess::Limits& limits);

}  // namespace lamina::cli
