#include "tests/fuzz/layers.h"

#include <cmath>
#include <cstdint>

#include "parser/diagnostic.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/inspect.h"
#include "slicer/inspection_text.h"
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

void read_layers(const std::string& path) {
  try_to([&] { slicer::read_layers(path, check); });
  try_to([&] {
    const slicer::Inspection found =
        slicer::inspect_file(path, kMinFeature, FileAccess());
    slicer::inspection_text(found, slicer::LayerList::kAll);
    slicer::inspection_json(found);
  });
}

}  // namespace lamina::fuzz
