#include "compiler/supports.h"

#include <fmt/format.h>

#include "compiler/look_at.h"
#include "slicer/plan/orientation.h"
#include "slicer/supports/support_text.h"

namespace lamina::compiler {
namespace {

// The design alone, where it stands by itself: the print is moved and enlarged
// with its supports.
Request without_supports(const Request& request) {
  Request part = request;
  part.supports.reset();
  part.geometry.scale = 1;
  part.geometry.is_placed_on_bed = false;
  part.job.written = {};
  part.job.min_feature = 0;
  part.job.finds_makers = false;
  return part;
}

// Of a turn: its transpose.
Affine inverse_of(const Affine& turn) {
  return {Vec3(turn[0].x, turn[1].x, turn[2].x),
          Vec3(turn[0].y, turn[1].y, turn[2].y),
          Vec3(turn[0].z, turn[1].z, turn[2].z), Vec3(0)};
}

}  // namespace

std::optional<slicer::SupportPlan> plan_supports(const Request& request,
                                                 std::size_t evaluation_stack,
                                                 TemporaryFiles& files) {
  const Request part = without_supports(request);
  Compilation compilation(part, files);
  compilation.evaluation_stack = evaluation_stack;
  try {
    const auto seen = look_at(compilation, {.keeps_layers = true});
    if (!seen) return std::nullopt;
    return slicer::plan_supports(seen->layers, *request.supports);
  } catch (const InternalError&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string support_lines(const slicer::SupportPlan& plan,
                          const GeometryRequest& geometry) {
  return slicer::support_text(
      plan, inverse_of(slicer::turn_to_axis(geometry.axis, geometry.turn)));
}

void warn_of_unheld(const slicer::SupportPlan& plan, Diagnostics& diagnostics) {
  for (const Vec3 place : plan.unheld) {
    diagnostics.own_warning(
        {}, fmt::format("no support finds a way to {:.2f}, {:.2f}, {:.2f}",
                        place.x, place.y, place.z));
  }
}

}  // namespace lamina::compiler
