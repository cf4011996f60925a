#pragma once
// What the readers of layer files have in common.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "base/file/file_bytes.h"
#include "base/vec.h"
#include "ldni/section/contours.h"

namespace lamina::slicer {

// Throws FileError, whose message begins with the file's name.
[[noreturn]] void fail_to_read(const std::string& path,
                               std::string_view message);

// The same for a file that FileAccess::open could not open: errno says why.
[[noreturn]] void fail_to_open(const std::string& path);

// Throws FileError where there is no regular file that can be read, AccessError
// for one that may not be.
FileBytes open_to_read(const std::string& path, const FileAccess& access);

// The number of the line that holds the byte at `place`, from 1.
std::size_t line_at(std::string_view text, std::size_t place);

// Reads a number at the front of `text` and takes it off; false where there is
// none that is finite. Blanks may stand before it.
bool take_number(std::string_view& text, double& value);

// Which way a file says that a loop runs.
enum class LoopKind { kOuter, kHole };

// Appends a loop as its kind has it, without a closing point. What has fewer
// than three points is no loop and is left out.
void add_loop(std::span<const Vec2> points, LoopKind kind,
              ldni::Contours& contours);

}  // namespace lamina::slicer
