#pragma once
// Messages about requests name options of the command line. Other interfaces
// have names of their own.

#include <functional>
#include <string>
#include <string_view>

namespace lamina::compiler {

// The text with each option in it, "--max-layer", replaced by what `own_name`
// makes of "max-layer".
std::string rename_options(
    std::string_view text,
    const std::function<std::string(std::string name)>& own_name);

}  // namespace lamina::compiler
