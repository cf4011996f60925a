#include "csg/import/detail/units.h"

#include <map>

#include <fmt/format.h>

namespace lamina::csg {

void heed_unit(std::string_view unit, Placing placing, PlacedMeshes& meshes) {
  static const std::map<std::string_view, double> kMillimetres = {
      {"", 1},        {"micron", 0.001}, {"millimeter", 1},
      {"inch", 25.4}, {"foot", 304.8},   {"feet", 304.8},
      {"meter", 1e3}, {"centimeter", 10}};
  const auto found = kMillimetres.find(unit);
  const bool is_known = found != kMillimetres.end();
  if (is_known && found->second == 1) return;
  if (!is_known || placing != Placing::kFile) {
    meshes.passed_over.push_back(
        fmt::format("has lengths in the unit '{}', taken for millimetres{}",
                    unit, is_known ? " as in OpenSCAD" : ""));
    return;
  }
  for (RawMesh& raw : meshes.bodies) {
    for (Vec3& vertex : raw.mesh.vertices) vertex *= found->second;
  }
}

}  // namespace lamina::csg
