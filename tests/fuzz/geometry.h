#pragma once
// What becomes of an imported file: a leaf, and layers.

#include <string>

#include "csg/tree.h"

namespace lamina::fuzz {

// Makes the import() of a file the whole design and slices it at few heights.
// Layers must be finite; errors that a design may have are none here.
void slice_import(const std::string& path, csg::ImportFormat format);

}  // namespace lamina::fuzz
