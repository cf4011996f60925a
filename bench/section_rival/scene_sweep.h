#pragma once
// Moves the cutting plane through a scene: meshes come, are cut, and go.

#include "base/file/output_file.h"
#include "csg/scene.h"

namespace lamina::rival {

// Writes all layers as SLC; the caller commits the output.
// thickness  of the layers [mm]
void slice_by_sections(const csg::Scene& scene, double thickness,
                       OutputFile& output);

}  // namespace lamina::rival
