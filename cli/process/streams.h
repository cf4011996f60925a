#pragma once
// The three standard streams, whatever the caller made of them.

#include <string_view>

namespace lamina::cli {

// Opens a place holder, which can be neither read nor written, for each stream
// that is closed: else the next file that is opened would get its number, and
// messages would go into the output.
void open_missing_streams();

// Nobody reads standard output any more, as behind `| head`.
struct ReaderGone {};

// Writes to standard output, at once. Throws FileError where that fails, but
// ReaderGone where nobody reads: the run then ends without a word.
void print_out(std::string_view text);

// Writes to standard error, without any memory but the stack.
void print_error(std::string_view text);

// Writes messages to standard error. On a terminal their first words, such as
// "error:", have a colour, unless NO_COLOR is set (no-color.org).
void print_messages(std::string_view text);

}  // namespace lamina::cli
