#include "slicer/plate/plate_layers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

// Layers that are under way at a time, so that all threads have work while one
// layer is written.
constexpr std::size_t kPlaces = 16;

struct Encoded {
  std::size_t index = 0;
  Layer layer;
  std::string bytes;
};

void add(const plane::Contours& contours, const PlateMotion& motion,
         plane::Contours& plate) {
  const auto begin = static_cast<std::uint32_t>(plate.points.size());
  for (const Vec2& point : contours.points) {
    plate.points.push_back(motion(point));
  }
  for (const std::uint32_t end : contours.ends) {
    plate.ends.push_back(begin + end);
  }
}

}  // namespace

PlateLayers::PlateLayers(std::span<const std::vector<Layer>> pieces,
                         std::vector<Placement> placements, double thickness)
    : pieces_(pieces),
      placements_(std::move(placements)),
      thickness_(thickness) {
  for (const Placement& placement : placements_) {
    const std::vector<Layer>& layers = pieces_[placement.piece];
    count_ = std::max(count_, first_of(layers) + layers.size());
  }
}

std::size_t PlateLayers::first_of(const std::vector<Layer>& layers) const {
  return static_cast<std::size_t>(
      std::llround(layers.front().section_z / thickness_ - 0.5));
}

Box3 PlateLayers::box() const {
  Box3 box;
  for (std::size_t i = 0; i < count_; ++i) {
    const Layer whole = layer(i);
    for (const Vec2& point : whole.contours.points) {
      box.add(Vec3(point, whole.bottom));
      box.add(Vec3(point, whole.top));
    }
  }
  return box;
}

Layer PlateLayers::layer(std::size_t index) const {
  Layer plate;
  plate.bottom = static_cast<double>(index) * thickness_;
  plate.section_z = (static_cast<double>(index) + 0.5) * thickness_;
  plate.top = static_cast<double>(index + 1) * thickness_;
  for (const Placement& placement : placements_) {
    const std::vector<Layer>& layers = pieces_[placement.piece];
    const std::size_t first = first_of(layers);
    if (index < first || index - first >= layers.size()) continue;
    const Layer& own = layers[index - first];
    const PlateMotion motion(placement.turn_deg, placement.shift);
    plate.compensation = own.compensation;
    add(own.contours, motion, plate.contours);
  }
  return plate;
}

void PlateLayers::send_to(LayerSink& sink) const {
  sink.begin(box());
  sink.expect(static_cast<std::uint32_t>(count_));
  std::vector<Encoded> places(kPlaces);
  std::size_t next = 0;
  run_in_order(places.size(), 0,
               {[&](std::size_t i) {
                  if (next == count_) return false;
                  places[i].index = next++;
                  return true;
                },
                [&](std::size_t i) {
                  places[i].layer = layer(places[i].index);
                  places[i].bytes.clear();
                  if (places[i].layer.contours.is_empty()) return;
                  places[i].bytes = sink.encode(places[i].layer);
                },
                [&](std::size_t i) {
                  sink.take_encoded(places[i].layer, places[i].bytes);
                }});
}

}  // namespace lamina::slicer
