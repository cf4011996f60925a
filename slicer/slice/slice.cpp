#include "slicer/slice/slice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/thread_clock.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/compensate.h"
#include "slicer/plan/adaptive.h"
#include "slicer/slice/detail/block_slicer.h"
#include "slicer/slice/detail/slice_job.h"
#include "slicer/slice/leaf_at.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer {
namespace {

// No machine builds so many layers: 500 m of the usual ones. Formats keep a
// table of them, and the planner of adaptive layers a ply for each.
constexpr double kMostLayers = 1e7;

void require_layers(const csg::Scene& scene, double thickness) {
  const double count = (scene.box.high.z - scene.box.low.z) / thickness;
  if (count <= kMostLayers) return;
  throw GeometryError(
      fmt::format("Too many layers: {:.3g} of {:g} mm, at most {:g} can be; "
                  "--layer makes them thicker",
                  count, thickness, kMostLayers));
}

// Reports faults of our own, which should never happen.
void warn_of_broken_promises(const SliceReport& report,
                             Diagnostics& diagnostics) {
  const auto warn = [&](std::uint64_t count, const char* what) {
    if (count == 0) return;
    diagnostics.warning({}, fmt::format("{} {}; the layers may be wrong there, "
                                        "please report",
                                        count, what));
  };
  warn(report.open_paths, "open paths in the sections of leaves were closed");
  warn(report.sweep.unbalanced_clusters,
       "event points of the ray left a leaf open");
  warn(report.sweep.repaired_clusters, "ends of boundary found no partner");
  warn(report.sweep.capped_clusters, "event points of the ray did not settle");
}

// Reports faults of what drew the leaves, which the layers do not have.
void warn_of_repairs(const SliceReport& report, Diagnostics& diagnostics) {
  if (report.paper.repaired_pixels == 0) return;
  diagnostics.warning(
      {},
      fmt::format("{} pixels that OpenGL ({}) drew more often from one side "
                  "than from the other were sampled exactly instead",
                  report.paper.repaired_pixels, report.renderer));
}

// The most that contours of a layer move.
double greatest_move(const Settings& settings) {
  return std::max(std::abs(settings.compensation),
                  std::abs(settings.compensation + settings.foot.inset));
}

// Reports what is too thin for the beam: the layers are right, the print will
// lack it.
//
// move  the most that contours move [mm]
void warn_of_losses(const CompensationCounts& losses, double move,
                    Diagnostics& diagnostics) {
  const auto warn = [&](std::uint64_t loops, const char* loop,
                        std::uint64_t gaps, const char* gap) {
    if (loops + gaps == 0) return;
    diagnostics.warning(
        {}, fmt::format("{} {} and {} {} of {} mm or less vanished in the "
                        "compensation, counted over all layers",
                        loops, loop, gaps, gap, 2 * move));
  };
  warn(losses.vanished_regions, "regions", losses.broken_walls, "walls");
  warn(losses.vanished_holes, "holes", losses.closed_gaps, "gaps");
}

[[noreturn]] void throw_empty(const SliceReport& report) {
  if (report.losses.vanished_regions > 0) {
    throw GeometryError("Nothing is left of the design after compensation.");
  }
  throw EmptyDesign();
}

// Throws where the design stands between the heights at which layers are cut.
void require_height(const csg::Scene& scene, const Settings& settings) {
  const double height = scene.box.size().z;
  if (!settings.heights.empty() || height > settings.layer_thickness) return;
  throw GeometryError(
      fmt::format("The design is {:g} mm high: too thin for layers of {:g} mm, "
                  "which are cut in their middle",
                  height, settings.layer_thickness));
}

[[noreturn]] void throw_out_of_range(const SliceReport& report,
                                     const LayerNumbers& wanted) {
  throw GeometryError(
      fmt::format("There is no layer {}: the layers are 1 to {}", wanted.first,
                  report.layers_there));
}

// What a tip holds is no overhang, unless the user says what is.
Settings with_hold(Settings settings, const csg::Scene& supports) {
  const double tip = supports.instances.front().support_tip;
  if (settings.print.self_supporting == 0 && tip > 0) {
    settings.print.self_supporting = hold_radius(tip, 0);
  }
  return settings;
}

// In the plane z = 0.
Box3 box_of(const plane::Contours& contours) {
  Box3 box;
  box.low.z = box.high.z = 0;
  for (const Vec2& point : contours.points) box.add(Vec3(point, 0));
  return box;
}

}  // namespace

bool makes_whole_print(const Settings& settings) {
  const LayerNumbers all;
  return settings.heights.empty() && settings.written.first == all.first &&
         settings.written.last == all.last;
}

bool moves_contours(const Settings& settings) {
  return settings.compensation != 0 || settings.foot.inset != 0;
}

std::optional<Deviation> promised_deviation(const Settings& settings) {
  if (settings.contour == ContourMode::kPaper) return std::nullopt;
  Deviation deviation;
  deviation.simplification = settings.tolerance;
  if (moves_contours(settings)) deviation.compensation = kArcTolerance;
  return deviation;
}

ldni::LayerGrid plan_layers(const csg::Scene& scene, const Settings& settings) {
  if (scene.box.is_empty() && settings.heights.empty()) throw_empty({});
  if (!settings.heights.empty()) {
    return ldni::LayerGrid::at_heights(settings.heights);
  }
  require_layers(scene, settings.layer_thickness);
  if (settings.cusp > 0) {
    return adaptive_grid(scene,
                         {settings.layer_thickness, settings.greatest_thickness,
                          settings.cusp, settings.most_thickness_runs});
  }
  return ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z,
                                  settings.layer_thickness);
}

void SliceReport::add(const LayerMeasures& layer, double bottom, double top) {
  ++layers;
  loops += layer.loops;
  holes += layer.holes;
  points += layer.vertices;
  greatest_area = std::max(greatest_area, layer.area);
  volume += layer.area * (top - bottom);
  if (layer.box.is_empty()) return;
  box.add({Vec3(layer.box.low, bottom), Vec3(layer.box.high, top)});
}

SliceReport slice(const csg::Scene& scene, const ldni::LayerGrid& grid,
                  const Settings& asked, LayerSink& sink,
                  Diagnostics& diagnostics) {
  SliceReport report;
  Plans plans;
  const std::optional<csg::Scene> supports = supports_of(scene);
  const Settings settings = supports ? with_hold(asked, *supports) : asked;
  csg::Scene part;
  std::vector<ColoredScene> colored;
  report.section_seconds = measure_seconds([&] {
    plans.whole = plan_blocks(scene, settings, grid);
    if (supports) {
      part = without_supports(scene);
      plans.part = plan_blocks(part, settings, grid);
      plans.supports = plan_blocks(*supports, settings, grid);
    }
    if (settings.keeps_colors) {
      colored = colored_parts_of(supports ? part : scene);
    }
    for (const ColoredScene& own : colored) {
      plans.colored.push_back(
          {own.color, plan_blocks(own.scene, settings, grid)});
    }
  });
  report.renderer = plans.whole.renderer;
  std::optional<FeatureCollector> features;
  if (settings.min_feature > 0) {
    features.emplace(settings.min_feature, source_ids(scene));
  }
  sink.begin(scene.box);
  sink.expect(grid.layer_count());
  std::optional<LayerGraph> graph;
  if (makes_whole_print(settings)) graph.emplace(settings.print);
  std::optional<SupportMeter> meter;
  if (supports && makes_whole_print(settings)) meter.emplace();
  run_slice_job(plans, grid, LayerInsets(scene, grid, settings), settings, sink,
                {features ? &*features : nullptr, graph ? &*graph : nullptr,
                 meter ? &*meter : nullptr},
                report);
  if (features) report.features = features->finish();
  if (graph) {
    report.print = graph->finish();
    if (settings.finds_makers) {
      report.graph_seconds += measure_seconds(
          [&] { find_makers(scene, grid, report.print->findings); });
    }
  }
  if (meter) {
    report.supports = meter->finish();
    if (settings.finds_makers) {
      report.graph_seconds += measure_seconds(
          [&] { find_makers(scene, grid, report.supports->contacts); });
    }
  }
  warn_of_broken_promises(report, diagnostics);
  warn_of_repairs(report, diagnostics);
  warn_of_losses(report.losses, greatest_move(settings), diagnostics);
  if (report.layers == 0) {
    if (report.layers_there > 0) throw_out_of_range(report, settings.written);
    require_height(scene, settings);
    throw_empty(report);
  }
  return report;
}

std::vector<Layer> all_layers(const csg::Scene& scene,
                              const Settings& settings) {
  LayerList list;
  Diagnostics unshown;
  slice(scene, plan_layers(scene, settings), settings, list, unshown);
  return std::move(list.layers);
}

std::vector<Layer> layers_or_none(const csg::Scene& scene,
                                  const Settings& asked) {
  Settings settings;
  settings.layer_thickness = asked.layer_thickness;
  settings.threads = asked.threads;
  try {
    return all_layers(scene, settings);
  } catch (const GeometryError&) {
    return {};
  }
}

SliceReport slice_outline(const plane::Region& outline,
                          const Settings& settings, LayerSink& sink,
                          Diagnostics& diagnostics) {
  Layer layer;
  layer.compensation = settings.compensation;
  layer.contours = to_contours(outline);
  SliceReport report;
  if (settings.min_feature > 0) {
    report.features = find_thin_features(layer, settings.min_feature);
  }
  report.losses = compensate(layer.contours, layer.compensation);
  report.layers_there = 1;
  if (!settings.written.contains(1)) {
    throw_out_of_range(report, settings.written);
  }
  report.add(measure(layer.contours), 0, 0);
  warn_of_losses(report.losses, std::abs(settings.compensation), diagnostics);
  if (layer.contours.is_empty()) throw_empty(report);
  sink.begin(box_of(layer.contours));
  sink.take(layer);
  return report;
}

}  // namespace lamina::slicer
