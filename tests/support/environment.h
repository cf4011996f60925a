#pragma once
// Numbers that make random tests longer, or other.

#include <cstdint>
#include <cstdlib>
#include <string>

namespace lamina::support {

// The number in an environment variable; `otherwise` where it is not set.
inline std::uint32_t number_from(const char* variable,
                                 std::uint32_t otherwise) {
  const char* const text = std::getenv(variable);
  if (text == nullptr) return otherwise;
  return static_cast<std::uint32_t>(std::stoul(text));
}

}  // namespace lamina::support
