#pragma once
// Literals as OpenSCAD shows them.

#include <string>
#include <string_view>

namespace lamina {

// Appends a number as OpenSCAD shows values: six significant digits, zeros cut
// off the end: 0.333333, 1e+6, inf, nan; never -0.
void append_number(double number, std::string& text);

// Appends "…" with \t \n \r \" \\ escaped.
void append_quoted(std::string_view content, std::string& text);

}  // namespace lamina
