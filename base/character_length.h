#pragma once
// Where characters end.

#include <cstddef>
#include <string_view>

namespace lamina {

// Length of the UTF-8 character at the beginning of `text`, which is not
// empty; 0 if there is none.
std::size_t character_length(std::string_view text);

}  // namespace lamina
