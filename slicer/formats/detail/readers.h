#pragma once
// The readers behind read_layers(): one function for each format, in a source
// file of its name. SLC has slc_reader.h.

#include <string>

#include "slicer/formats/layer_reader.h"

namespace lamina::slicer {

using ReadLayers = LayerFileFacts(const std::string& path,
                                  const TakeLayer& take,
                                  const FileAccess& access);

ReadLayers read_cli;
ReadLayers read_layers_json;
ReadLayers read_svg;

}  // namespace lamina::slicer
