#pragma once
// Where the sources are that these tests read.

#include <filesystem>

namespace lamina::testing {

inline const std::filesystem::path kRoot = LAMINA_SOURCE_DIR;

}  // namespace lamina::testing
