#include "compiler/inspect_file.h"

#include <cstddef>
#include <utility>

#include "compiler/request.h"
#include "csg/lower/mesh_file_facts.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/output_format.h"
#include "slicer/formats/slc_reader.h"

namespace lamina::compiler {

using slicer::Layer;

slicer::Inspection inspect_file(const std::string& path,
                                const slicer::InspectOptions& options,
                                const FileAccess& access) {
  slicer::Inspector inspector(options);
  if (!slicer::is_named(path, ".slc")) {
    slicer::LayerFileFacts facts = slicer::read_layers(
        path, [&](Layer& layer) { inspector.take(layer); }, access);
    return inspector.finish(path, std::move(facts));
  }
  // SLC's boundaries as they are: they may be open.
  slicer::SlcReader reader(path, access);
  slicer::SlcLayer written;
  std::size_t count = 0;
  while (reader.read_layer(written)) {
    const Layer layer = to_layer(written);
    slicer::require_within_reach(path, layer, ++count);
    inspector.take(layer, written.boundaries);
  }
  slicer::require_layers(path, count);
  return inspector.finish(path, reader.facts());
}

std::vector<csg::MeshFacts> inspect_meshes(const std::string& path,
                                           const FileAccess& access) {
  if (!is_imported(path)) return {};
  return csg::measure_mesh_file(path, access);
}

}  // namespace lamina::compiler
