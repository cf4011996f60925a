#include "compiler/sprues.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/source_lines.h"
#include "slicer/casting/sprue_text.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {
namespace {

// The design alone, where it stands by itself.
Request without_sprues(const Request& request) {
  Request piece = as_drawn(request);
  piece.sprues.reset();
  return piece;
}

void name_lines(const csg::Scene& scene, slicer::SpruePlan& plan) {
  for (slicer::Sprue& sprue : plan.sprues) {
    sprue.at = text_of(lines_of(scene, sprue.instance, slicer::kNoInstance));
  }
}

// Rods of a millimetre lead nowhere from what is much smaller.
void require_size(Vec3 size) {
  constexpr double kSmallest = 0.25;  // [mm]
  if (std::max({size.x, size.y, size.z}) >= kSmallest) return;
  throw GeometryError(
      fmt::format("The design is {:g} x {:g} x {:g} mm, too small for sprues: "
                  "are its units millimetres?",
                  size.x, size.y, size.z));
}

void warn_of_seen(const slicer::SpruePlan& plan, Diagnostics& diagnostics) {
  for (const slicer::Sprue& sprue : plan.sprues) {
    if (!sprue.is_seen) continue;
    diagnostics.own_warning(
        {}, fmt::format("a sprue comes out where the piece is seen ($visible), "
                        "at {}",
                        place_text(sprue.exit)));
  }
}

}  // namespace

bool is_sprue(const csg::Instance& instance) {
  return slicer::is_made_by(instance, {&slicer::kSpruesModule, 1});
}

std::optional<slicer::SpruePlan> plan_sprues(const Request& request,
                                             std::size_t evaluation_stack,
                                             TemporaryFiles& files,
                                             Diagnostics& diagnostics) {
  Compilation compilation(without_sprues(request), files);
  compilation.evaluation_stack = evaluation_stack;
  std::optional<csg::Lowered> lowered;
  try {
    lowered = make_geometry(compilation);
    if (!lowered) return std::nullopt;
  } catch (const InternalError&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
  if (lowered->scene() == nullptr) {
    throw GeometryError("--sprue needs a solid; the design is flat");
  }
  const csg::Scene& scene = *lowered->scene();
  require_size(scene.box.size());
  if (std::ranges::any_of(scene.instances, is_sprue)) {
    throw GeometryError("The design has sprues already");
  }
  const slicer::SolidSamples samples = slicer::sample_casting(scene);
  const slicer::BallFinder balls(samples.points);
  auto plan = slicer::plan_sprues(samples, balls,
                                  slicer::measure_thickness(samples, balls),
                                  *request.sprues, [&](std::uint32_t instance) {
                                    return scene.instances[instance].is_visible;
                                  });
  if (!plan) {
    throw GeometryError(
        "No straight sprue gets out of the design's thick places; draw one, or "
        "mark less as $visible");
  }
  name_lines(scene, *plan);
  warn_of_seen(*plan, diagnostics);
  return plan;
}

std::vector<slicer::Pool> unfed_by(const csg::Scene& scene, Vec3 root) {
  const slicer::SolidSamples samples = slicer::sample_casting(scene);
  const slicer::BallFinder balls(samples.points);
  return slicer::unfed_of(slicer::find_pools(
      samples, balls, slicer::measure_thickness(samples, balls),
      {{.place = root}}));
}

}  // namespace lamina::compiler
