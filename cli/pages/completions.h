#pragma once
// Completion of the command line by the three usual shells: commands, options,
// words that options take, files by their extensions.
//
// What every completion of a shell has stands in a frame (cli/pages/*.in).

#include <span>
#include <string>

#include "cli/pages/command_pages.h"

namespace lamina::cli {

std::string bash_completion(std::span<const CommandPage> pages,
                            std::string frame);
std::string zsh_completion(std::span<const CommandPage> pages,
                           std::string frame);
std::string fish_completion(std::span<const CommandPage> pages,
                            std::string frame);

}  // namespace lamina::cli
