#include "slicer/machine/material.h"

#include "slicer/machine/detail/profile.h"

namespace lamina::slicer {
namespace {

using nlohmann::json;

constexpr double kGreatestDensity = 25;  // [g/cm³]; osmium has 22.6
constexpr double kGreatestExposure = 1000;
constexpr double kGreatestPrice = 1e9;

Material read_material(const json& object) {
  detail::require_members(object, {"name", "title", "source", "density",
                                   "exposure_s", "first_exposure_s", "printer",
                                   "layer_mm", "price_per_litre", "currency"});
  Material material;
  material.name = detail::read_line(object, "name");
  material.title = detail::read_line(object, "title", material.name);
  material.source = detail::read_line(object, "source", "");
  object.at("density");  // which none can do without
  material.density =
      detail::read_number(object, "density", 0.01, kGreatestDensity, 0);
  material.exposure =
      detail::read_number(object, "exposure_s", 0, kGreatestExposure, 0);
  material.first_exposure = detail::read_number(
      object, "first_exposure_s", 0, kGreatestExposure, material.exposure);
  material.printer = detail::read_line(object, "printer", "");
  material.layer_thickness = detail::read_number(object, "layer_mm", 0, 10, 0);
  material.price =
      detail::read_number(object, "price_per_litre", 0, kGreatestPrice, 0);
  material.currency = detail::read_line(object, "currency", "");
  return material;
}

}  // namespace

std::vector<Material> known_materials() {
  std::vector<Material> materials;
  for (const std::string_view profile : detail::kMaterialProfiles) {
    materials.push_back(read_material(json::parse(profile)));
  }
  return materials;
}

Material find_material(const std::string& name_or_file,
                       const FileAccess& access) {
  Material material;
  detail::read_profile(
      "material", name_or_file, detail::kMaterialProfiles, access,
      [&](const json& object) { material = read_material(object); });
  return material;
}

}  // namespace lamina::slicer
