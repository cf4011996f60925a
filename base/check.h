#pragma once
// LAMINA_CHECK_EQ(a, b) checks a promise of our own. Where it broke, it throws
// InternalError: "internal error, please report", with both values.

#include <string>

namespace lamina {
[[noreturn]] void fail_check(const char* file, int line, const char* claim,
                             const std::string& left, const std::string& right);
}  // namespace lamina

#define LAMINA_CHECK_EQ(a, b)                                \
  do {                                                       \
    const auto& lamina_left = (a);                           \
    const auto& lamina_right = (b);                          \
    if (!(lamina_left == lamina_right)) {                    \
      ::lamina::fail_check(__FILE__, __LINE__, #a " == " #b, \
                           std::to_string(lamina_left),      \
                           std::to_string(lamina_right));    \
    }                                                        \
  } while (false)
