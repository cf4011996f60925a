#pragma once
// The manual page. What it says of commands and options is what --help says;
// the rest stands in docs/man/lamina.1.in.

#include <span>
#include <string>

#include "cli/pages/command_pages.h"

namespace lamina::cli {

// frame  holds @VERSION@, and lines @SYNOPSIS@, @OPTIONS@, @COMMANDS@ and
//        @EXAMPLES@
std::string man_page(std::span<const CommandPage> pages, std::string frame);

}  // namespace lamina::cli
