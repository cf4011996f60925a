#pragma once
// What becomes of a file of layers.

#include <string>
#include <vector>

#include "slicer/contour/layer.h"

namespace lamina::fuzz {

// Reads it as `lamina view` does, and looks for its defects as `lamina inspect`
// does. That it is no such file is no finding. Returns what could be read.
std::vector<slicer::Layer> read_layers(const std::string& path);

// Draws layers as `lamina view` does (the first that has a contour, a sheet, a
// page, a stack but for OpenGL's part) and compares each with the first as
// `lamina compare` does.
void use_layers(const std::vector<slicer::Layer>& layers);

}  // namespace lamina::fuzz
