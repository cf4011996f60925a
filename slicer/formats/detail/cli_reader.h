#pragma once
// Reads CLI 2.0 files, ASCII and binary (docs/formats.md).
//
// Closed polylines become loops; hatches and open polylines are counted and
// left out. A layer reaches from the one before up to its z. The first one
// begins at the lower corner that the header tells, else it is as thick as the
// second. If that corner lies at the first z itself, all layers are sections at
// their z, without thickness.

#include <string>

#include "slicer/formats/layer_reader.h"

namespace lamina::slicer {

LayerFileFacts read_cli(const std::string& path, const TakeLayer& take,
                        const FileAccess& access);

}  // namespace lamina::slicer
