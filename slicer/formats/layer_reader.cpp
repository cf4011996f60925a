#include "slicer/formats/layer_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "slicer/formats/detail/reading.h"
#include "slicer/formats/output_format.h"
#include "slicer/formats/slc_reader.h"

namespace lamina::slicer {
namespace {

// A file with a coordinate farther from the origin than this [mm] is broken,
// and would overflow what counts in integers.
constexpr double kGreatestCoordinate = 1e9;

LayerFileFacts read_slc(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  SlcReader reader(path, access);
  SlcLayer slc_layer;
  while (reader.read_layer(slc_layer)) {
    Layer layer = to_layer(slc_layer);
    take(layer);
  }
  return reader.facts();
}

struct Format {
  std::string_view ending;
  ReadLayers* read;
};
constexpr std::array<Format, 11> kFormats = {{
    {".slc", read_slc},
    {".cli", read_cli},
    {".svg", read_svg},
    {".layers.json", read_layers_json},
    {".3mf", read_3mf},
    {".sl1", read_image_archive},
    {".zip", read_image_archive},
    {".nanodlp", read_image_archive},
    {".goo", read_goo},
    {".ctb", read_ctb},
    {".png", read_image_folder},
}};

ReadLayers* reader_for(std::string_view path) {
  while (path.ends_with('/')) path.remove_suffix(1);
  for (const Format& format : kFormats) {
    if (is_named(path, format.ending)) return format.read;
  }
  return nullptr;
}

bool is_within_reach(double value) {
  return std::abs(value) <= kGreatestCoordinate;
}

bool is_within_reach(const Layer& layer) {
  return is_within_reach(layer.bottom) && is_within_reach(layer.top) &&
         is_within_reach(layer.section_z) &&
         std::ranges::all_of(layer.contours.points, [](const Vec2& point) {
           return is_within_reach(point.x) && is_within_reach(point.y);
         });
}

}  // namespace

void require_within_reach(const std::string& path, const Layer& layer,
                          std::size_t number) {
  if (is_within_reach(layer)) return;
  fail_to_read(path, fmt::format("layer {} reaches farther than {:g} mm from "
                                 "the origin",
                                 number, kGreatestCoordinate));
}

void require_layers(const std::string& path, std::size_t count) {
  if (count == 0) fail_to_read(path, "it holds no layers");
}

bool is_readable_layer_file(const std::string& path, const FileAccess& access) {
  ReadLayers* const read = reader_for(path);
  if (read == read_3mf) return has_slices(path, access);
  if (read == read_image_folder) return is_image_folder(path, access);
  return read != nullptr;
}

LayerFileFacts read_layers(const std::string& path, const TakeLayer& take,
                           const FileAccess& access) {
  ReadLayers* const read = reader_for(path);
  if (read == nullptr) {
    fail_to_read(
        path,
        "layers are read from .slc, .cli, .svg, .3mf, .sl1, .zip, "
        ".nanodlp, .goo, .ctb, .layers.json and folders of images only");
  }
  std::size_t count = 0;
  LayerFileFacts facts = read(
      path,
      [&](Layer& layer) {
        require_within_reach(path, layer, ++count);
        take(layer);
      },
      access);
  require_layers(path, count);
  return facts;
}

}  // namespace lamina::slicer
