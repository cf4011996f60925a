#pragma once
// The three standard streams, whatever the caller made of them.

#include <string>
#include <string_view>

namespace lamina::cli {

// Opens a place holder, which can be neither read nor written, for each stream
// that is closed: else the next file that is opened would get its number, and
// messages would go into the output.
void open_missing_streams();

// Names files in that folder from there, from now on: under --root messages may
// reach strangers, who need not know where the folder is.
void name_files_from(const std::string& folder);

// What a message says, with the files of that folder named so.
std::string with_short_paths(std::string text);

// Writes to standard output, at once. Throws FileError where that fails.
void print_out(std::string_view text);

// Writes to standard error, without any memory but the stack.
void print_error(std::string_view text);

}  // namespace lamina::cli
