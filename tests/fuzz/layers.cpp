#include "tests/fuzz/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "cli/report/inspection_text.h"
#include "compiler/look_at.h"
#include "slicer/check/compare/compare.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/picture/detail/trapezoids.h"
#include "slicer/picture/layer_picture.h"
#include "slicer/picture/sheet_picture.h"
#include "slicer/picture/viewer_page.h"
#include "tests/fuzz/input.h"

namespace lamina::fuzz {
namespace {

constexpr double kMinFeature = 0.4;  // [mm]

void check(const slicer::Layer& layer) {
  require(std::isfinite(layer.bottom) && std::isfinite(layer.top),
          "heights are finite");
  std::uint32_t end = 0;
  for (const std::uint32_t next : layer.contours.ends) {
    require(next >= end, "loops follow each other");
    end = next;
  }
  require(end == layer.contours.points.size(), "each point is of a loop");
}

// No finding where the file is at fault.
template <typename Read>
void try_to(const Read& read) {
  try {
    read();
  } catch (const FileError&) {
  }
}

}  // namespace

std::vector<slicer::Layer> read_layers(const std::string& path) {
  std::vector<slicer::Layer> layers;
  try_to([&] {
    slicer::read_layers(path, [&](slicer::Layer& layer) {
      check(layer);
      layers.push_back(std::move(layer));
    });
  });
  try_to([&] {
    const slicer::Inspection found =
        compiler::look_at_file(
            path, {.finds_defects = true, .min_feature = kMinFeature}, {},
            FileAccess())
            .found;
    cli::inspection_text(found, cli::ListedLayers::kAll);
    cli::inspection_json(found);
  });
  return layers;
}

void use_layers(const std::vector<slicer::Layer>& layers) {
  const auto drawn = std::find_if(
      layers.begin(), layers.end(),
      [](const slicer::Layer& layer) { return !layer.contours.is_empty(); });
  if (drawn == layers.end()) return;
  constexpr unsigned kWidth = 200;  // as small as may be [pixels]
  slicer::draw_layer_picture(layers,
                             static_cast<std::size_t>(drawn - layers.begin()),
                             "layer", {kWidth, kMinFeature});
  slicer::draw_sheet(layers, "sheet", {kWidth, 4});
  slicer::ViewerOptions page;
  page.min_feature = kMinFeature;
  slicer::viewer_page(layers, page);
  for (const slicer::Layer& layer : layers) {
    std::vector<slicer::Trapezoid> trapezoids;
    slicer::cut_into_trapezoids(layer.contours, trapezoids);
    slicer::compare_layers(layer.contours, drawn->contours);
  }
}

}  // namespace lamina::fuzz
