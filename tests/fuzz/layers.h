#pragma once
// What becomes of a file of layers.

#include <string>

namespace lamina::fuzz {

// Reads it as `lamina view` does, and looks for its defects as `lamina inspect`
// does. That it is no such file is no finding.
void read_layers(const std::string& path);

// Draws what can be read of it as `lamina view` does (the first layer that has
// a contour, a sheet, a page, a stack but for OpenGL's part) and compares each
// layer with the first as `lamina compare` does.
void use_layers(const std::string& path);

}  // namespace lamina::fuzz
