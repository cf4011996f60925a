#pragma once
// Moves the cutting plane through a scene: meshes come, are cut, and go.

#include "csg/scene.h"
#include "slicer/formats/output_file.h"

namespace lamina::rival {

// Writes all layers as SLC; the caller commits the output.
// thickness  of the layers [mm]
void slice_by_sections(const csg::Scene& scene, double thickness,
                       slicer::OutputFile& output);

}  // namespace lamina::rival
