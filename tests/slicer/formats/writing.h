#pragma once
// Layers made by hand, and what a writer makes of layers.

#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "slicer/formats/layer_writer.h"
#include "tests/support/contour_checks.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {

inline Layer layer_at(double bottom, double top,
                      const std::vector<std::vector<Vec2>>& loops) {
  Layer layer;
  layer.bottom = bottom;
  layer.top = top;
  layer.section_z = (bottom + top) / 2;
  for (const auto& loop : loops) support::add_loop(layer.contours, loop);
  return layer;
}

// A square with a square hole, an empty layer, a triangle; numbers that float32
// holds.
inline std::vector<Layer> three_layers() {
  return {layer_at(1.0, 1.5,
                   {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                    {{1, 1}, {1, 3}, {3, 3}, {3, 1}}}),
          layer_at(1.5, 2.0, {}),
          layer_at(2.0, 2.5, {{{-2, 0.5}, {2, 0.5}, {0, 3}}})};
}

// The bytes that a writer writes.
inline std::string written(const std::vector<Layer>& layers,
                           const WriterOptions& options,
                           Diagnostics& diagnostics) {
  const support::TemporaryFolder folder;
  TemporaryFiles files;
  const std::string path = folder.file("layers");
  const auto writer = make_layer_writer(options, path, files);
  for (const Layer& layer : layers) writer->take(layer);
  writer->finish(diagnostics);
  writer->commit();
  return support::read_file(path);
}
inline std::string written(const std::vector<Layer>& layers,
                           const WriterOptions& options) {
  Diagnostics unheard;
  return written(layers, options, unheard);
}

}  // namespace lamina::slicer
