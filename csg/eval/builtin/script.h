#pragma once
// The script of a text ("Latn", "Arab"), which `.csg` shows and which decides
// the direction of writing.

#include <string>
#include <string_view>

namespace lamina::csg {

// The ISO 15924 tag: the one asked for, else that of the text's characters;
// empty where these have no script (digits, blanks) or several.
std::string text_script(std::string_view text, std::string_view asked);

// "ltr", "rtl", "ttb" or "btt": as asked, else by the script.
std::string_view text_direction(std::string_view script,
                                std::string_view asked);

}  // namespace lamina::csg
