#pragma once
// Numbers that people type outside of a design: options, cells of tables.

#include <optional>
#include <string_view>

namespace lamina {

// A finite number and nothing else, such as "-1.5e3"; no value for all other
// texts.
std::optional<double> parse_number(std::string_view text);

}  // namespace lamina
