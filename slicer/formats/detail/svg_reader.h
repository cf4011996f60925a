#pragma once
// Reads layers from SVG files in the layout of Slic3r (docs/formats.md): a
// group with slic3r:z for each layer, polygons of type contour and hole in it.
//
// Slic3r's own files differ from lamina's: y runs upwards there, coordinates
// begin at the lower left corner of the part, and version 1.3 writes heights in
// a millionth of millimetres.

#include <string>

#include "slicer/formats/layer_reader.h"

namespace lamina::slicer {

LayerFileFacts read_svg(const std::string& path, const TakeLayer& take,
                        const FileAccess& access);

}  // namespace lamina::slicer
