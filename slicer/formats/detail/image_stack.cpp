#include "slicer/formats/detail/image_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "base/version.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::ordered_json;

// Usual times [s]; printers have their own or let users set them.
constexpr double kExposure = 8;
constexpr double kFirstExposure = 35;

std::string print(const Json& json) { return json.dump(1) + "\n"; }

std::string index_of(const ImageStack& stack) {
  Json index;
  index["software"] = fmt::format("lamina {}", version());
  index["units"] = "mm";
  index["pixels"] = {stack.panel.width, stack.panel.height};
  index["pixel_mm"] = {stack.panel.pixel.x, stack.panel.pixel.y};
  index["layer_thickness"] = stack.layer_thickness;
  index["volume_mm3"] = stack.volume;
  Json& layers = index["layers"] = Json::array();
  for (std::size_t i = 0; i < stack.layers.size(); ++i) {
    layers.push_back({{"file", image_name(stack, i)},
                      {"z", stack.layers[i].z},
                      {"thickness", stack.layers[i].thickness}});
  }
  return print(index);
}

// What Prusa's printers and UVtools read.
std::string sl1_config(const ImageStack& stack) {
  return fmt::format(
      "action = print\n"
      "expTime = {}\n"
      "expTimeFirst = {}\n"
      "jobDir = {}\n"
      "layerHeight = {:.6g}\n"
      "numFade = 10\n"
      "numFast = {}\n"
      "numSlow = 0\n"
      "printerModel = {}\n"
      "printerVariant = default\n"
      "prusaSlicerVersion = lamina-{}\n"
      "usedMaterial = {:.6f}\n",
      kExposure, kFirstExposure, stack.job, stack.layer_thickness,
      stack.layers.size(), stack.panel.name == "prusa-sl1s" ? "SL1S" : "SL1",
      version(), stack.volume / 1000);
}

// A number of six decimals at most, and of none where it is whole: some readers
// accept nothing else as a count.
Json number(double value) {
  constexpr double kPerUnit = 1e6;
  const double rounded = std::round(value * kPerUnit) / kPerUnit;
  if (rounded == std::trunc(rounded)) {
    return static_cast<std::int64_t>(rounded);
  }
  return rounded;
}

// NanoDLP has thicknesses in µm and the rest in mm.
Json micrometres(double mm) { return number(1000 * mm); }

// The box of all layers, from the middle of the panel [mm].
Json boundary_of(const ImageStack& stack) {
  const Panel& panel = stack.panel;
  const Vec2 middle = Vec2(panel.width, panel.height) / 2.0;
  Vec2 low = 2.0 * middle;
  Vec2 high(0);
  for (const ImageLayer& layer : stack.layers) {
    if (layer.regions.empty()) continue;
    low = glm::min(low, layer.low);
    high = glm::max(high, layer.high);
  }
  low = (glm::min(low, high) - middle) * panel.pixel;
  high = (high - middle) * panel.pixel;
  const double height =
      stack.layer_thickness * static_cast<double>(stack.layers.size());
  return {{"XMin", number(low.x)},
          {"XMax", number(high.x)},
          {"YMin", number(low.y)},
          {"YMax", number(high.y)},
          {"ZMin", 0},
          {"ZMax", number(height)}};
}

Json meta_of() {
  return {{"FormatVersion", 1},   {"Distro", "generic"}, {"Program", "lamina"},
          {"Version", version()}, {"OS", "linux"},       {"Arch", "amd64"},
          {"Profile", false}};  // the printer's own profile counts
}

Json slicer_of(const ImageStack& stack) {
  const Panel& panel = stack.panel;
  const Json thickness = micrometres(stack.layer_thickness);
  return {{"Type", "png"},
          {"PWidth", panel.width},
          {"PHeight", panel.height},
          {"XPixelSize", panel.pixel.x},
          {"YPixelSize", panel.pixel.y},
          {"XOffset", number(panel.width / 2.0)},
          {"YOffset", number(panel.height / 2.0)},
          {"Thickness", thickness},
          {"SupportDepth", thickness},
          {"LayerCount", stack.layers.size()},
          {"ImageMirror", panel.is_mirrored() ? 1 : 0},
          {"DisplayController", 1},  // one grey a pixel, not colours
          {"Boundary", boundary_of(stack)}};
}

Json plate_of(const ImageStack& stack) {
  Json plate = {{"PlateID", 0},
                {"ProfileID", 0},
                {"Path", stack.job},
                {"LayersCount", stack.layers.size()},
                {"TotalSolidArea", number(stack.volume / 1000)}};  // [ml]
  plate.update(boundary_of(stack));
  return plate;
}

Json profile_of(const ImageStack& stack) {
  const Json thickness = micrometres(stack.layer_thickness);
  return {{"ResinID", 0},
          {"ProfileID", 0},
          {"Title", stack.panel.name},
          {"Desc", fmt::format("lamina {}", version())},
          {"Depth", thickness},
          {"SupportDepth", thickness},
          {"CureTime", number(kExposure)},
          {"SupportCureTime", number(kFirstExposure)},
          {"SupportLayerNumber", 1}};
}

Json info_of(const ImageLayer& layer) {
  const auto& regions = layer.regions;
  const auto [smallest, largest] = std::ranges::minmax_element(regions);
  return {
      {"TotalSolidArea", std::accumulate(regions.begin(), regions.end(), 0.0)},
      {"LargestArea", regions.empty() ? 0 : *largest},
      {"SmallestArea", regions.empty() ? 0 : *smallest},
      {"MinX", std::floor(layer.low.x)},
      {"MinY", std::floor(layer.low.y)},
      {"MaxX", std::ceil(layer.high.x)},
      {"MaxY", std::ceil(layer.high.y)},
      {"AreaCount", regions.size()}};
}

std::vector<StackText> nanodlp_texts(const ImageStack& stack) {
  Json info = Json::array();
  for (const ImageLayer& layer : stack.layers) info.push_back(info_of(layer));
  return {{"meta.json", print(meta_of())},
          {"slicer.json", print(slicer_of(stack))},
          {"plate.json", print(plate_of(stack))},
          {"profile.json", print(profile_of(stack))},
          {"info.json", print(info)}};
}

}  // namespace

std::string image_name(const ImageStack& stack, std::size_t layer) {
  if (stack.format == OutputFormat::kNanoDlp) {
    return fmt::format("{}.png", layer + 1);
  }
  const bool is_sl1 = stack.format == OutputFormat::kSl1;
  return fmt::format("{}{:05}.png", is_sl1 ? stack.job : "", layer);
}

std::vector<StackText> stack_texts(const ImageStack& stack) {
  switch (stack.format) {
    case OutputFormat::kSl1:
      return {{"config.ini", sl1_config(stack)}};
    case OutputFormat::kNanoDlp:
      return nanodlp_texts(stack);
    default:
      return {{kFolderContents, index_of(stack)}};
  }
}

}  // namespace lamina::slicer
