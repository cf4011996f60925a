#pragma once
// Layers back from files, whatever their format (docs/formats.md).
//
// Nothing in a file is trusted: what breaks the format's frame is a FileError
// with its line or byte offset. What merely breaks a rule (loops that cross,
// layers that do not rise) is handed over.

#include <functional>
#include <string>
#include <string_view>

#include "base/file/file_access.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_file.h"

namespace lamina::slicer {

// Gets the layers in the order of the file, and may take their memory. Loops
// have no closing point. Where the format says which loops are holes (all but
// SLC) these run clockwise, the others counter-clockwise.
using TakeLayer = std::function<void(Layer&)>;

// Whether the file can be read: by its name .slc .cli .svg .sl1 .zip .nanodlp
// .goo .ctb .layers.json, in any letter case, a .3mf that holds slices, or a
// folder .png.
bool is_readable_layer_file(const std::string& path,
                            const FileAccess& access = kAllFiles);

// Throws FileError, also for a file that is_readable_layer_file() does not
// take, and AccessError for one that may not be read.
LayerFileFacts read_layers(const std::string& path, const TakeLayer& take,
                           const FileAccess& access = kAllFiles);

// Throws FileError for a layer that reaches farther from the origin than a
// print can; read_layers() does so for each.
//
// number  the layer's, from 1
void require_within_reach(const std::string& path, const Layer& layer,
                          std::size_t number);

// Throws FileError for a file without layers; read_layers() does so.
void require_layers(const std::string& path, std::size_t count);

}  // namespace lamina::slicer
