#pragma once
// Reads .layers.json files (docs/formats.md). Members that are not known are
// passed over; the document is never in memory as a whole.

#include <string>

#include "slicer/formats/layer_reader.h"

namespace lamina::slicer {

LayerFileFacts read_layers_json(const std::string& path, const TakeLayer& take,
                                const FileAccess& access);

}  // namespace lamina::slicer
