#pragma once
// The program's version, as `--version` and the files it writes show it.

#include <string_view>

namespace lamina {

std::string_view version();

}  // namespace lamina
