#include "compiler/look_at.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "compiler/compile.h"
#include "compiler/validate.h"
#include "csg/lower/mesh_file_facts.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/slc_reader.h"

namespace lamina::compiler {
namespace {

using slicer::Layer;

// Inspects layers and keeps them if asked.
class Looker : public slicer::LayerSink {
 public:
  Looker(const LookOptions& options, bool makes_graph,
         const slicer::PrintRules& rules)
      : keeps_layers_(options.keeps_layers),
        inspector_({.finds_defects = options.finds_defects,
                    .min_feature = options.min_feature,
                    .makes_graph = makes_graph,
                    .print = rules}) {}

  void take(const Layer& layer) override {
    inspector_.take(layer);
    if (keeps_layers_) layers_.push_back(layer);
  }
  void take(Layer&& layer) {
    inspector_.take(layer);
    if (keeps_layers_) layers_.push_back(std::move(layer));
  }
  // Takes a layer with its loops as the file has them.
  void take(Layer layer, std::span<const slicer::WrittenLoop> loops) {
    inspector_.take(layer, loops);
    if (keeps_layers_) layers_.push_back(std::move(layer));
  }

  Inspection finish(std::string name, slicer::LayerFileFacts facts) {
    Inspection inspection;
    inspection.found = inspector_.finish(std::move(name), std::move(facts));
    inspection.layers = std::move(layers_);
    return inspection;
  }

 private:
  const bool keeps_layers_;
  slicer::Inspector inspector_;
  std::vector<Layer> layers_;
};

// Takes SLC's boundaries as they are: they may be open.
slicer::LayerFileFacts read_slc(const std::string& path, Looker& looker,
                                const FileAccess& access) {
  slicer::SlcReader reader(path, access);
  slicer::SlcLayer written;
  std::size_t count = 0;
  while (reader.read_layer(written)) {
    Layer layer = to_layer(written);
    slicer::require_within_reach(path, layer, ++count);
    looker.take(std::move(layer), written.boundaries);
  }
  slicer::require_layers(path, count);
  return reader.facts();
}

// Of more rays, some gigabytes of points would come [1].
constexpr double kMostRays = 4e6;

// Whether the place is thin in a layer, too, which shows it exactly.
bool is_in_layers(const slicer::ThinPlace& place, double width) {
  const double level = std::hypot(place.across.x, place.across.y);
  return level > 0 && place.width / level < width;
}

std::optional<std::vector<HiddenThin>> find_hidden(const csg::Scene& scene,
                                                   double width) {
  const double pitch = slicer::kThinPitchShare * width;
  const Vec3 steps = scene.box.size() / pitch;
  if (steps.x * steps.y + steps.y * steps.z + steps.z * steps.x > kMostRays) {
    return std::nullopt;
  }
  const slicer::SolidSamples samples = slicer::sample_solid(scene, pitch);
  const slicer::BallFinder balls(samples.points);
  std::vector<HiddenThin> hidden;
  for (const auto& place : slicer::find_thin_places(samples, balls, width)) {
    if (place.shape == slicer::ThinShape::kEdge ||
        !slicer::is_too_thin(place, width) || is_in_layers(place, width)) {
      continue;
    }
    hidden.push_back(
        {place, lines_of(scene, place.instances[0], place.instances[1])});
  }
  return hidden;
}

}  // namespace

bool holds_layers(const std::string& path, const FileAccess& access) {
  return slicer::is_readable_layer_file(path, access);
}

void refuse_design_options(const DesignRequest& request,
                           const std::string& path) {
  refuse_if(!request.given_option.empty(),
            "{} needs a design; '{}' holds layers", request.given_option, path);
}

void require_readable(std::string_view command, const std::string& path) {
  refuse_if(slicer::is_named_as_layers(path) && !is_imported(path) &&
                !slicer::is_readable_layer_file(path),
            "{} reads files of layers, folders of images, designs and meshes; "
            "not '{}'",
            command, path);
}

Inspection look_at_file(const std::string& path, const LookOptions& options,
                        const slicer::PrintRules& rules,
                        const FileAccess& access) {
  Looker looker(options, options.makes_graph, rules);
  slicer::LayerFileFacts facts =
      slicer::is_named(path, ".slc")
          ? read_slc(path, looker, access)
          : slicer::read_layers(
                path, [&](Layer& layer) { looker.take(std::move(layer)); },
                access);
  return looker.finish(path, std::move(facts));
}

Inspection look_at_design(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid, const Request& request,
                          const Machine& machine, const LookOptions& options,
                          const Progress& progress, Diagnostics& diagnostics) {
  slicer::Settings settings = settings_of(request, machine);
  settings.keeps_colors = options.keeps_colors;
  Looker looker(options, false, {});
  slicer::SliceReport report =
      slice(lowered, grid, settings, looker, progress, diagnostics);
  slicer::LayerFileFacts exact;
  exact.is_float32 = false;
  Inspection inspection = looker.finish(request.design.path, std::move(exact));
  inspection.lines = find_lines(lowered, report);
  inspection.found.print = std::move(report.print);
  inspection.found.supports = std::move(report.supports);
  if (settings.min_feature > 0) {
    inspection.found.features = std::move(report.features);
    if (options.finds_hidden && lowered.scene() != nullptr) {
      inspection.hidden = find_hidden(*lowered.scene(), settings.min_feature);
    }
  }
  return inspection;
}

std::optional<Inspection> look_at(Compilation& c, const LookOptions& options) {
  const Request& request = c.request;
  const std::string& path = request.design.path;
  c.report.machine = choose_machine(request.output, c.file_access());
  if (holds_layers(path, c.file_access())) {
    refuse_design_options(request.design, path);
    return look_at_file(path, options,
                        settings_of(request, c.report.machine).print,
                        c.file_access());
  }
  const auto lowered = make_geometry(c);
  if (!lowered) return std::nullopt;
  Inspection inspection = look_at_design(
      *lowered, plan(*lowered, settings_of(request, c.report.machine)), request,
      c.report.machine, options, c.on_progress, c.diagnostics);
  if (options.finds_defects && is_imported(path)) {
    inspection.found.meshes = csg::measure_mesh_file(path, c.file_access());
  }
  return inspection;
}

}  // namespace lamina::compiler
