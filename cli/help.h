#pragma once
// What `--help` shows, for the program and for its commands. Written by hand:
// a page that a person reads once is worth its own order and words. A test
// compares it with the options that there are.

#include <string_view>

namespace lamina::cli {

extern const std::string_view kHelp;
extern const std::string_view kInspectHelp;
extern const std::string_view kViewHelp;

}  // namespace lamina::cli
