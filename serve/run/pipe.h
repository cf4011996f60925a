#pragma once
// Pipes from processes.

#include <optional>
#include <string>

namespace lamina::serve {

// What can be read now, at most 64 kB. Empty at the end; no value where there
// is nothing: a server may call for what a descriptor of the same number had.
std::optional<std::string> read_some(int pipe);

}  // namespace lamina::serve
