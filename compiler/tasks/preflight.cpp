#include "compiler/tasks/preflight.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "compiler/compile.h"
#include "compiler/machine.h"
#include "compiler/passes.h"
#include "compiler/validate.h"
#include "csg/boundary/move_scene.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/check/print/pole.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/plan/orientation.h"
#include "slicer/plate/footprint.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {
namespace {

// Engravings are looked for with rays of their own, whose pitch is this share
// of the least depth.
constexpr double kDepthPitchShare = 0.2;

// Fingers fit into holes of these diameters [mm], from the smallest child's
// ring to the largest size that is sold.
constexpr double kLeastFinger = 11;
constexpr double kGreatestFinger = 27;
// Layers in which the hole is looked for, and how exactly their union is made
// [mm].
constexpr double kFingerLayer = 0.2;
constexpr double kFingerTolerance = 0.001;

constexpr const char* kUsualMetals[] = {"sterling-silver", "gold-14k-yellow",
                                        "gold-18k-yellow", "platinum-950"};

// The metal that is named, or the printed material if that is a metal.
slicer::Material metal_of(const Machine& machine) {
  const std::optional<slicer::Material>& metal =
      machine.metal ? machine.metal : machine.material;
  if (!metal || !metal->is_metal()) {
    throw RequestError(
        "preflight needs a metal: --metal sterling-silver, or another of "
        "'lamina materials'");
  }
  if (!metal->casting) {
    throw RequestError(
        fmt::format("the profile of {} says nothing of its castings "
                    "(\"casting\"; see docs/formats.md)",
                    metal->title));
  }
  return *metal;
}

double distance_to(std::span<const Vec2> loop, Vec2 place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    least = std::min(least, distance_to_segment(place, loop[i],
                                                loop[(i + 1) % loop.size()]));
  }
  return least;
}

// The diameter of the largest circle in a hole: uphill from its pole, in steps
// that shrink.
double circle_in(std::span<const Vec2> hole) {
  plane::Contours around;
  around.add_loop(std::vector<Vec2>(hole.rbegin(), hole.rend()));
  Vec2 middle = slicer::pole_of(around);
  double radius = distance_to(hole, middle);
  for (double step = radius / 4; step > 1e-5;) {
    bool has_grown = false;
    const Vec2 here = middle;
    for (int i = 0; i < 9; ++i) {
      const Vec2 place = here + step * Vec2(i % 3 - 1, i / 3 - 1);
      const double distance = distance_to(hole, place);
      if (distance <= radius) continue;
      radius = distance;
      middle = place;
      has_grown = true;
    }
    if (!has_grown) step /= 2;
  }
  return 2 * radius;
}

// The hole that a finger fits through: the largest circle in the shadow's holes
// along any axis.
double find_finger(const csg::Scene& scene, slicer::Settings settings) {
  settings.layer_thickness = std::max(settings.layer_thickness, kFingerLayer);
  double widest = 0;
  for (const char* axis : {"z", "x", "y"}) {
    csg::Scene turned = scene;
    csg::move_scene(turned, slicer::turn_to_axis(axis), Vec3(0));
    const plane::Region shadow = slicer::footprint_of(
        slicer::all_layers(turned, settings), kFingerTolerance);
    for (const std::vector<Vec2>& loop : shadow.contours) {
      if (signed_area(loop) >= 0) continue;
      const double diameter = circle_in(loop);
      if (diameter >= kLeastFinger && diameter <= kGreatestFinger) {
        widest = std::max(widest, diameter);
      }
    }
  }
  return widest;
}

class Inspector {
 public:
  Inspector(const csg::Scene& scene, const PreflightOptions& options,
            Preflight& found)
      : scene_(scene), options_(options), found_(found) {}

  void measure() {
    const slicer::CastingLimits& limits = *found_.metal.casting;
    found_.pitch = slicer::kThinPitchShare *
                   std::min({limits.wall, limits.wire, limits.gap});
    const slicer::SolidSamples samples =
        slicer::sample_solid(scene_, found_.pitch);
    const slicer::BallFinder balls(samples.points);
    for (const slicer::SurfacePoint& point : samples.points) {
      found_.area += point.area;
    }
    find_thin(samples, balls, limits);
    if (limits.engraving > 0) find_shallow(limits);
    find_unfed();
  }

 private:
  void find_thin(const slicer::SolidSamples& samples,
                 const slicer::BallFinder& balls,
                 const slicer::CastingLimits& limits) {
    const double widest = std::max({limits.wall, limits.wire, limits.gap});
    for (const auto& place : slicer::find_thin_places(samples, balls, widest)) {
      const bool is_wire = place.shape == slicer::ThinShape::kWire;
      const double least = place.is_gap ? limits.gap
                           : is_wire    ? limits.wire
                                        : limits.wall;
      if (!slicer::is_too_thin(place, least)) continue;
      if (place.shape == slicer::ThinShape::kEdge) {
        if (!place.is_gap) ++found_.edges;
        continue;
      }
      found_.too_thin.push_back(
          {place, least,
           lines_of(scene_, place.instances[0], place.instances[1])});
    }
  }

  void find_shallow(const slicer::CastingLimits& limits) {
    const double least = limits.engraving;
    const slicer::SolidSamples samples =
        slicer::sample_solid(scene_, kDepthPitchShare * least);
    const slicer::BallFinder balls(samples.points);
    for (const auto& engraving : slicer::find_engravings(
             samples, balls, {kWidestEngraving * least, least})) {
      if (engraving.depth >= slicer::kLetPass * least) continue;
      if (engraving.area < limits.gap * limits.gap) continue;
      found_.too_shallow.push_back(
          {engraving, least,
           lines_of(scene_, engraving.instances[0], engraving.instances[1])});
    }
  }

  void find_unfed() {
    slicer::SolidSamples samples = slicer::sample_casting(scene_);
    const slicer::BallFinder balls(samples.points);
    const auto field = slicer::measure_thickness(samples, balls);
    found_.gates = options_.gates;
    found_.is_reached.assign(samples.cells.size(), true);
    for (const auto& pool :
         slicer::find_pools(samples, balls, field, options_.gates)) {
      found_.thickest = std::max(found_.thickest, pool.thickness);
      if (!pool.is_fed) {
        for (const std::uint32_t cell : pool.cells) {
          found_.is_reached[cell] = false;
        }
        found_.unfed.push_back({pool, lines_at(samples, balls, pool)});
      } else if (found_.gates.empty()) {
        found_.gates.push_back({pool.place, pool.thickness});
      }
    }
    found_.cells = std::move(samples.cells);
  }

  // The line whose surface is nearest to the neck.
  SourceLines lines_at(const slicer::SolidSamples& samples,
                       const slicer::BallFinder& balls,
                       const slicer::Pool& pool) const {
    const Vec3 place = pool.neck_thickness > 0 ? pool.neck : pool.place;
    const auto nearest =
        balls.nearest(place, std::numeric_limits<double>::infinity());
    if (!nearest) return {};
    return lines_of(scene_, samples.points[nearest->point].instance,
                    slicer::kNoInstance);
  }

  const csg::Scene& scene_;
  const PreflightOptions& options_;
  Preflight& found_;
};

}  // namespace

double european_ring_size(double diameter) {
  return std::numbers::pi * diameter;
}

double american_ring_size(double diameter) {
  constexpr double kSizeZero = 11.63;  // [mm]
  constexpr double kStep = 0.8128;     // 0.032 inches
  return (diameter - kSizeZero) / kStep;
}

std::optional<Preflight> preflight(Compilation& c,
                                   const PreflightOptions& options) {
  c.report.machine = choose_machine(c.request.output, c.file_access());
  c.request.compensation = {0, slicer::Foot(), 0};
  Preflight found;
  found.metal = metal_of(c.report.machine);
  found.metals = {found.metal};
  for (const char* name : kUsualMetals) {
    if (name != found.metal.name) {
      found.metals.push_back(slicer::find_material(name));
    }
  }
  const auto lowered = make_geometry(c);
  if (!lowered) return std::nullopt;
  if (lowered->scene() == nullptr) {
    throw GeometryError("The design is flat: a solid was expected");
  }
  const csg::Scene& scene = *lowered->scene();
  const slicer::Settings settings = settings_of(c.request, c.report.machine);
  found.layers = slicer::all_layers(scene, settings);
  found.volume = slicer::volume_of(found.layers);
  for (const slicer::Layer& layer : found.layers) {
    const Box2 box = box_of(layer.contours.points);
    if (box.is_empty()) continue;
    found.box.add(Vec3(box.low, layer.bottom));
    found.box.add(Vec3(box.high, layer.top));
  }
  found.parameters = list_parameters(c.design.program);
  found.stones = find_stones(found.parameters);
  found.finger = find_finger(scene, settings);
  Inspector(scene, options, found).measure();
  return found;
}

}  // namespace lamina::compiler
