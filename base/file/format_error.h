#pragma once
// What is wrong with the contents of a file.

#include <stdexcept>

namespace lamina {

// Thrown by readers. The message names format and place, but not the file:
// "STL line 12, extra vertex line 'vertex 0 0 1'".
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lamina
