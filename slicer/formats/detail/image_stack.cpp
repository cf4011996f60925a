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

std::string print(const Json& json) { return json.dump(1) + "\n"; }

std::string index_of(const ImageStack& stack) {
  Json index;
  index["software"] = fmt::format("lamina {}", version());
  index["units"] = "mm";
  index["pixels"] = {stack.printer.width, stack.printer.height};
  index["pixel_mm"] = {stack.printer.pixel.x, stack.printer.pixel.y};
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

const char* prusa_model(const Printer& printer) {
  return printer.name == "prusa-sl1s" ? "SL1S" : "SL1";
}

// What Prusa's printers read; the members are those that PrusaSlicer 2.5
// writes. The date is the one that ZIP begins with, as that of all entries.
std::string sl1_config(const ImageStack& stack) {
  const Exposure& exposure = stack.exposure;
  return fmt::format(
      "action = print\n"
      "expTime = {}\n"
      "expTimeFirst = {}\n"
      "expUserProfile = 0\n"
      "fileCreationTimestamp = 1980-01-01 at 00:00:00 UTC\n"
      "hollow = 0\n"
      "jobDir = {}\n"
      "layerHeight = {:.6g}\n"
      "materialName = {}\n"
      "numFade = {}\n"
      "numFast = {}\n"
      "numSlow = 0\n"
      "printProfile = \n"
      "printTime = {:.6f}\n"
      "printerModel = {}\n"
      "printerProfile = {}\n"
      "printerVariant = default\n"
      "prusaSlicerVersion = lamina-{}\n"
      "usedMaterial = {:.6f}\n",
      exposure.layer, exposure.first, stack.job, stack.layer_thickness,
      stack.material, kFadeLayers, stack.layers.size(),
      print_seconds(stack.printer, exposure, stack.layers.size()),
      prusa_model(stack.printer), stack.printer.title, version(),
      stack.volume / 1000);
}

// The settings of PrusaSlicer that say how the images were made, for programs
// that convert the archive. It counts the long side of the panel first.
std::string sl1_settings(const ImageStack& stack) {
  const Printer& printer = stack.printer;
  const bool is_portrait = printer.right.x == 0;
  const Vec2 size = Vec2(printer.width, printer.height) * printer.pixel;
  const auto mirrors = [](double direction) { return direction < 0 ? 1 : 0; };
  return fmt::format(
      "display_height = {:.6g}\n"
      "display_mirror_x = {}\n"
      "display_mirror_y = {}\n"
      "display_orientation = {}\n"
      "display_pixels_x = {}\n"
      "display_pixels_y = {}\n"
      "display_width = {:.6g}\n"
      "exposure_time = {}\n"
      "faded_layers = {}\n"
      "gamma_correction = 1\n"
      "initial_exposure_time = {}\n"
      "initial_layer_height = {:.6g}\n"
      "layer_height = {:.6g}\n"
      "max_print_height = {:.6g}\n"
      "printer_model = {}\n"
      "printer_settings_id = {}\n"
      "printer_technology = SLA\n"
      "printer_variant = default\n"
      "sla_material_settings_id = {}\n",
      is_portrait ? size.x : size.y,
      is_portrait ? (printer.is_mirrored() ? 1 : 0) : mirrors(printer.right.x),
      is_portrait ? 0 : mirrors(printer.up.y),
      is_portrait ? "portrait" : "landscape",
      is_portrait ? printer.height : printer.width,
      is_portrait ? printer.width : printer.height,
      is_portrait ? size.y : size.x, stack.exposure.layer, kFadeLayers,
      stack.exposure.first, stack.layer_thickness, stack.layer_thickness,
      printer.build_height, prusa_model(printer), printer.title,
      stack.material);
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

// The box of all layers, from the middle of the printer [mm].
Json boundary_of(const ImageStack& stack) {
  const Printer& printer = stack.printer;
  const Vec2 middle = Vec2(printer.width, printer.height) / 2.0;
  Vec2 low = 2.0 * middle;
  Vec2 high(0);
  for (const ImageLayer& layer : stack.layers) {
    if (layer.regions.empty()) continue;
    low = glm::min(low, layer.low);
    high = glm::max(high, layer.high);
  }
  low = (glm::min(low, high) - middle) * printer.pixel;
  high = (high - middle) * printer.pixel;
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
  const Printer& printer = stack.printer;
  const Json thickness = micrometres(stack.layer_thickness);
  return {{"Type", "png"},
          {"PWidth", printer.width},
          {"PHeight", printer.height},
          {"XPixelSize", printer.pixel.x},
          {"YPixelSize", printer.pixel.y},
          {"XOffset", number(printer.width / 2.0)},
          {"YOffset", number(printer.height / 2.0)},
          {"Thickness", thickness},
          {"SupportDepth", thickness},
          {"LayerCount", stack.layers.size()},
          {"ImageMirror", printer.is_mirrored() ? 1 : 0},
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
          {"Title", stack.printer.name},
          {"Desc", fmt::format("lamina {}", version())},
          {"Depth", thickness},
          {"SupportDepth", thickness},
          {"CureTime", number(stack.exposure.layer)},
          {"SupportCureTime", number(stack.exposure.first)},
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
      return {{"config.ini", sl1_config(stack)},
              {"prusaslicer.ini", sl1_settings(stack)}};
    case OutputFormat::kNanoDlp:
      return nanodlp_texts(stack);
    default:
      return {{kFolderContents, index_of(stack)}};
  }
}

}  // namespace lamina::slicer
