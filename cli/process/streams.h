#pragma once
// The three standard streams, whatever the caller made of them.

#include <string_view>

namespace lamina::cli {

// Gives what is closed a place holder that can be neither read nor written:
// else the next file that is opened would be taken for it, and messages would
// go into the output.
void open_missing_streams();

// To standard output, at once. Throws FileError where it does not get there.
void print_out(std::string_view text);

// To standard error, without any memory but the stack.
void print_error(std::string_view text);

}  // namespace lamina::cli
