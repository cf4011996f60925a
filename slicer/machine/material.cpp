#include "slicer/machine/material.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "base/text.h"
#include "csg/support_tip.h"
#include "slicer/machine/detail/profile.h"

namespace lamina::slicer {
namespace {

using nlohmann::json;

constexpr double kGreatestDensity = 25;  // [g/cm³]; osmium has 22.6
constexpr double kGreatestExposure = 1000;
constexpr double kGreatestPrice = 1e9;
// Of what castings need [mm]: what is thinner is nothing to look for.
constexpr double kLeastCasting = 0.05;
constexpr double kGreatestCasting = 10;
constexpr double kTroyOunce = 31.1034768;  // [g]

KnownExposure read_exposure(const json& object) {
  detail::require_members(object, {"exposure_s", "first_exposure_s", "printer",
                                   "layer_mm", "source"});
  KnownExposure known;
  object.at("exposure_s");  // which none can do without
  known.exposure.layer =
      detail::read_number(object, "exposure_s", 0, kGreatestExposure, 0);
  known.exposure.first = detail::read_number(
      object, "first_exposure_s", 0, kGreatestExposure, known.exposure.layer);
  known.printer = detail::read_line(object, "printer", "");
  known.layer_thickness = detail::read_number(object, "layer_mm", 0, 10, 0);
  known.source = detail::read_line(object, "source", "");
  return known;
}

Price read_price(const json& object, const char* member,
                 std::string_view unit) {
  return {detail::read_number(object, member, 0, kGreatestPrice, 0),
          detail::read_line(object, "currency", ""), std::string(unit)};
}

CastingLimits read_casting(const json& object) {
  detail::require_members(object,
                          {"wall_mm", "wire_mm", "gap_mm", "engraving_depth_mm",
                           "finishing_mm", "source"});
  const auto read = [&](const char* member, double least) {
    object.at(member);  // which none can do without
    return detail::read_number(object, member, least, kGreatestCasting, 0);
  };
  return {read("wall_mm", kLeastCasting),
          read("wire_mm", kLeastCasting),
          read("gap_mm", kLeastCasting),
          object.contains("engraving_depth_mm")
              ? read("engraving_depth_mm", kLeastCasting)
              : 0,
          read("finishing_mm", 0),
          detail::read_line(object, "source", "")};
}

// What the foot fades over, unless given, are the layers that are cured
// longest.
static_assert(Foot().layers == kFirstLayers);

Compensation read_compensation(const json& object) {
  detail::require_members(
      object, {"contour_mm", "foot_mm", "foot_layers", "bleed_mm", "source"});
  Compensation compensation;
  compensation.contour = detail::read_number(
      object, "contour_mm", -kGreatestCompensation, kGreatestCompensation, 0);
  Foot& foot = compensation.foot;
  foot.inset = detail::read_number(object, "foot_mm", 0, kGreatestFoot, 0);
  const double layers = detail::read_number(object, "foot_layers", 1,
                                            kMostFootLayers, foot.layers);
  if (layers != std::floor(layers)) {
    throw std::runtime_error("'foot_layers' is not a whole number");
  }
  foot.layers = static_cast<std::uint32_t>(layers);
  compensation.bleed =
      detail::read_number(object, "bleed_mm", 0, kGreatestBleed, 0);
  detail::read_line(object, "source", "");
  return compensation;
}

Material read_material(const json& object) {
  detail::require_members(
      object, {"name", "title", "also", "source", "density", "exposures",
               "price_per_litre", "price_per_gram", "price_per_ounce",
               "currency", "support_tip_mm", "casting", "compensation"});
  Material material;
  material.name = detail::read_line(object, "name");
  material.title = detail::read_line(object, "title", material.name);
  material.also = detail::read_lines(object, "also");
  material.source = detail::read_line(object, "source", "");
  object.at("density");  // which none can do without
  material.density =
      detail::read_number(object, "density", 0.01, kGreatestDensity, 0);
  material.support_tip =
      detail::read_number(object, "support_tip_mm", csg::kLeastSupportTip,
                          csg::kGreatestSupportTip, 0);
  if (object.contains("casting")) {
    material.casting = read_casting(object.at("casting"));
  }
  if (object.contains("compensation")) {
    material.compensation = read_compensation(object.at("compensation"));
  }
  if (object.contains("exposures")) {
    for (const json& exposure : object.at("exposures")) {
      material.exposures.push_back(read_exposure(exposure));
    }
  }
  for (const auto& [member, unit] :
       {std::pair{"price_per_litre", "l"}, std::pair{"price_per_gram", "g"},
        std::pair{"price_per_ounce", "oz"}}) {
    if (!object.contains(member)) continue;
    if (material.price) throw std::runtime_error("it has two prices");
    material.price = read_price(object, member, unit);
  }
  return material;
}

}  // namespace

double Exposure::of(std::size_t index) const {
  if (index < kFirstLayers) return first;
  const double step = (first - layer) / static_cast<double>(kFadeLayers + 1);
  const double faded =
      first - step * static_cast<double>(index - kFirstLayers + 1);
  return index < kFirstLayers + kFadeLayers ? faded : layer;
}

double Price::of(double grams, double volume_mm3) const {
  if (unit == "l") return amount * volume_mm3 / 1e6;
  if (unit == "kg") return amount * grams / 1000;
  return unit == "oz" ? amount * grams / kTroyOunce : amount * grams;
}

std::optional<Price> parse_price(std::string_view text) {
  const std::size_t slash = text.rfind('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const std::string_view unit = text.substr(slash + 1);
  if (std::ranges::find(kPriceUnits, unit) == std::end(kPriceUnits)) {
    return std::nullopt;
  }
  const std::string_view sum = text.substr(0, slash);
  const std::size_t digits =
      std::min(sum.find_first_not_of("0123456789."), sum.size());
  const std::optional<double> amount = parse_number(sum.substr(0, digits));
  if (!amount || *amount > kGreatestPrice) return std::nullopt;
  const std::size_t word =
      std::min(sum.find_first_not_of(' ', digits), sum.size());
  if (sum.find_first_of("0123456789/", word) != std::string_view::npos) {
    return std::nullopt;
  }
  return Price{*amount, on_one_line(std::string(sum.substr(word))),
               std::string(unit)};
}

const std::vector<Material>& known_materials() {
  static const std::vector<Material> materials = [] {
    std::vector<Material> all;
    for (const std::string_view profile : detail::kMaterialProfiles) {
      all.push_back(read_material(json::parse(profile)));
    }
    return all;
  }();
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
