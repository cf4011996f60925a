#include "csg/import/detail/units.h"

#include <fmt/format.h>

#include "base/file/length_units.h"

namespace lamina::csg {

void heed_unit(std::string_view unit, Placing placing, PlacedMeshes& meshes) {
  // AMF has another word for it than 3MF.
  const double length = length_of_unit(unit == "feet" ? "foot" : unit);
  if (length == 1) return;
  if (length == 0 || placing != Placing::kFile) {
    meshes.passed_over.push_back(
        fmt::format("has lengths in the unit '{}', taken for millimetres{}",
                    unit, length == 0 ? "" : " as in OpenSCAD"));
    return;
  }
  for (RawMesh& raw : meshes.bodies) {
    for (Vec3& vertex : raw.mesh.vertices) vertex *= length;
  }
}

}  // namespace lamina::csg
