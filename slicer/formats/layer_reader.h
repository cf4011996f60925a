#pragma once
// Layers back from files, whatever their format (docs/formats.md).
//
// One way in for all who read layers: `lamina view`, `inspect`, `compare`.
// Files come from anywhere, so nothing in them is trusted: what breaks the
// format's frame is a FileError with its line or byte offset. What merely
// breaks a rule (loops that cross, layers that do not rise) is handed over.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/file/file_access.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

// Given the layers in the order of the file; may take their memory. Loops have
// no closing point. Where the format says which loops are holes (all but SLC)
// those run clockwise, the others counter-clockwise.
using TakeLayer = std::function<void(Layer&)>;

// What a file tells beside its layers.
struct LayerFileFacts {
  std::string format;  // "SLC 2.0", "CLI, binary"
  std::string writer;  // program that made it; empty: not told
  // What contours deviate by from the design's sections, if told [mm].
  std::optional<double> deviation;
  // Coordinates are 32-bit numbers.
  bool is_float32 = true;
  // false: only heights of sections; sides of layers are then halfway between.
  bool has_sides = true;
  std::uint64_t lines_left_out = 0;  // hatches and open polylines
};

// By its name: .slc .cli .svg .layers.json, in any letter case.
bool is_readable_layer_file(std::string_view path);

// Throws FileError, also for a file whose name is_readable_layer_file() does
// not take, and AccessError for one that may not be read.
LayerFileFacts read_layers(const std::string& path, const TakeLayer& take,
                           const FileAccess& access = kAllFiles);

// Throws FileError for a layer that reaches farther from the origin than a
// print can: read_layers() gives none.
//
// number  the layer's, from 1
void require_within_reach(const std::string& path, const Layer& layer,
                          std::size_t number);

}  // namespace lamina::slicer
