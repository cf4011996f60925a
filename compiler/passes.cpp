#include "compiler/passes.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "base/file/module.h"
#include "base/paths.h"
#include "compiler/warnings.h"
#include "csg/boundary/move_scene.h"
#include "csg/eval/evaluator.h"
#include "parser/customizer/definitions.h"
#include "parser/customizer/parameter_set.h"
#include "slicer/plan/orientation.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

ast::Program read_design(const DesignRequest& request, Loader& loader) {
  if (request.text) return loader.load_text(request.path, *request.text);
  if (is_imported(request.path)) {
    return loader.load_text(request.path, import_of(request.path, request.part),
                            true);
  }
  return loader.load(request.path);
}

std::string place_of(const NewerSyntax& newer) {
  const SourceRange& range = newer.range;
  return fmt::format("{}:{}: {}", display_path(range.source->path()),
                     range.source->line_column(range.begin).line, newer.what);
}

void say_newer(const NewerSyntax& newer, Diagnostics& diagnostics) {
  diagnostics.own_remark(
      {}, fmt::format("read as OpenSCAD 2026 ({})", place_of(newer)));
}

// What only a later version than 2021.01 can parse was not written for it.
Language choose_language(const DesignRequest& request, const Loader& loader,
                         Diagnostics& diagnostics) {
  if (request.language == "2021") return Language::k2021;
  if (request.language == "2026") return Language::k2026;
  const std::optional<NewerSyntax>& newer = loader.newer_syntax();
  if (!newer) return Language::k2021;
  say_newer(*newer, diagnostics);
  return Language::k2026;
}

// False where the set cannot be applied, which is reported.
bool apply_parameters(const DesignRequest& request, const FileAccess& access,
                      LoadedDesign& design, Diagnostics& diagnostics) {
  const auto apply = [&](const ParameterSet& set) {
    return apply_parameter_set(set, design.program, design.language,
                               diagnostics, request.misfit);
  };
  if (request.parameters) return apply(*request.parameters);
  if (request.parameter_file.empty()) return true;
  try {
    return apply(ParameterSets::read(request.parameter_file, access)
                     .values_of(request.parameter_set));
  } catch (const FileError& fault) {
    diagnostics.report(fault.diagnostic());
    return false;
  }
}

csg::EvaluateOptions evaluate_options(const Request& request) {
  const DesignRequest& design = request.design;
  csg::EvaluateOptions options;
  options.is_file = !design.text && is_imported(design.path);
  // As openscad sets it for each of its outputs.
  const bool has_preview = request.output.format == OutputFormat::kCsg ||
                           request.output.format == OutputFormat::kEcho;
  options.preview =
      has_preview && (design.render.empty() || !design.preview.empty());
  options.seed = design.seed;
  options.check_parameters = design.checks_parameters;
  options.check_ranges = design.checks_parameter_ranges;
  options.max_depth = design.max_depth;
  options.max_leaves = design.max_leaves;
  const Vec3 scale = request.geometry.scale;
  options.chordal_error =
      (request.geometry.chordal_error > 0 ? request.geometry.chordal_error
                                          : csg::kChordalErrorOfParts) /
      std::max({scale.x, scale.y, scale.z});
  return options;
}

csg::LowerOptions lower_options(const GeometryRequest& request,
                                Readers& readers) {
  csg::LowerOptions options;
  options.world_from_design = turn_of(request);
  options.chordal_error = request.chordal_error;
  options.decimation = request.decimation;
  options.module_folders = readers.module_folders;
  options.typesetter = &readers.typesetter;
  options.cad_reader = &readers.cad_reader;
  options.file_access = &readers.file_access;
  options.scale = request.scale;
  return options;
}

// What would go wrong if the scene were printed as it stands.
std::string problems_of(const csg::Scene& scene, slicer::Settings settings) {
  settings.min_feature = 0;
  settings.finds_makers = false;
  slicer::LayerDrain sink;
  Diagnostics unshown;  // the run itself will say it
  const auto report = slicer::slice(scene, slicer::plan_layers(scene, settings),
                                    settings, sink, unshown);
  return report.print ? report.print->counts(slicer::kAllFindings) : "";
}

slicer::OrientationChoice choose_orientation(const csg::Scene& scene,
                                             const Request& request,
                                             const Machine& machine) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const slicer::Settings settings = settings_of(request, machine);
  slicer::OrientationChoice choice = slicer::choose_orientation(
      scene, settings.layer_thickness,
      machine.printer ? machine.printer->build_volume() : Vec3(kAny));
  // As chosen the run itself will say it. As drawn it costs a slicing.
  slicer::Orientation& drawn = choice.all.front();
  if (choice.best != 0 && drawn.fits && drawn.size.z > 0) {
    drawn.problems = problems_of(scene, settings);
  }
  return choice;
}

// Turns the scene to the axis that is best, and says why.
void turn_automatically(const Request& request, const Machine& machine,
                        csg::Scene& scene, Diagnostics& diagnostics) {
  const slicer::OrientationChoice choice =
      choose_orientation(scene, request, machine);
  const slicer::Orientation& best = choice.all[choice.best];
  csg::move_scene(scene, slicer::turn_to_axis(best.axis, best.turn), Vec3(0));
  std::istringstream table(slicer::orientation_table(choice));
  for (std::string line; std::getline(table, line);) {
    diagnostics.report({Severity::kPlain, {}, line});
  }
}

// Counts layers on their way to a sink. Both must outlive it; the progress may
// be empty.
class CountingSink : public slicer::ForwardingSink {
 public:
  CountingSink(slicer::LayerSink& sink, const Progress& progress)
      : ForwardingSink(sink), progress_(progress) {}

  void expect(std::uint32_t layers) override {
    all_ = layers;
    ForwardingSink::expect(layers);
    if (progress_) progress_(0, all_);
  }
  void take_encoded(const slicer::Layer& layer,
                    const std::string& encoded) override {
    ForwardingSink::take_encoded(layer, encoded);
    if (progress_) progress_(++done_, all_);
  }
  // Fewer layers can come than were expected.
  void finish() const {
    if (progress_) progress_(all_, all_);
  }

 private:
  const Progress& progress_;
  std::uint64_t done_ = 0;
  std::uint64_t all_ = 0;
};

// Folders of modules, the one that is asked for first.
std::vector<std::string> module_folders_of(const DesignRequest& request) {
  std::vector<std::string> folders = module_folders();
  if (!request.module_folder.empty()) {
    folders.insert(folders.begin(), request.module_folder);
  }
  return folders;
}

// Whether the format shows a 2D design; the others are printed.
bool holds_outlines(OutputFormat format) {
  return format == OutputFormat::kSvg || format == OutputFormat::kLayersJson;
}

}  // namespace

Readers::Readers(const DesignRequest& request, const FileAccess& access,
                 Diagnostics& diagnostics)
    : file_access(access),
      module_folders(module_folders_of(request)),
      typesetter(module_folders, diagnostics, access),
      cad_reader(module_folders, diagnostics) {}

Affine turn_of(const GeometryRequest& request) {
  if (request.axis == kAutomaticAxis) return Affine(1.0);
  const Affine turn = slicer::turn_to_axis(request.axis, request.turn);
  if (!request.up) return turn;
  return turn * Mat4(slicer::turn_upwards(*request.up));
}

LoadedDesign read(const DesignRequest& request, Loader& loader,
                  Diagnostics& diagnostics) {
  LoadedDesign design;
  loader.append(request.appended);
  design.program = read_design(request, loader);
  design.language = choose_language(request, loader, diagnostics);
  check_definitions(design.program, loader, diagnostics);
  return design;
}

void set_parameters(const DesignRequest& request, const FileAccess& access,
                    LoadedDesign& design, Diagnostics& diagnostics) {
  design.has_parameters =
      apply_parameters(request, access, design, diagnostics);
}

namespace {

// Evaluates a design whose text leaves the language open: as 2021.01, until
// what runs was not written for that. Messages wait for what comes of it.
csg::Tree find_language_and_evaluate(LoadedDesign& design, const Loader& loader,
                                     csg::EvaluateOptions& options,
                                     Diagnostics& diagnostics) {
  options.finds_language = true;
  Diagnostics waiting;
  waiting.set_hard_warnings(diagnostics.has_hard_warnings());
  const auto report_all = [&] {
    for (const Diagnostic& message : waiting.all()) diagnostics.report(message);
  };
  csg::Tree tree;
  try {
    tree = csg::evaluate(design.program, loader, options, waiting);
  } catch (...) {
    report_all();
    throw;
  }
  if (tree.newer) {
    say_newer(*tree.newer, diagnostics);
    design.language = options.language = Language::k2026;
    options.finds_language = false;
    return csg::evaluate(design.program, loader, options, diagnostics);
  }
  report_all();
  if (tree.difference) {
    diagnostics.own_remark(
        {}, fmt::format("read as OpenSCAD 2021.01; newer ones may give other "
                        "layers ({}), --language decides",
                        place_of(*tree.difference)));
  }
  return tree;
}

}  // namespace

csg::Tree evaluate(LoadedDesign& design, const Request& request,
                   const Loader& loader, Readers& readers,
                   std::size_t stack_bytes, Diagnostics& diagnostics) {
  readers.typesetter.add_fonts(loader.fonts());
  csg::EvaluateOptions options = evaluate_options(request);
  options.language = design.language;
  options.stack_bytes = stack_bytes;
  options.text_measurer = &readers.typesetter;
  const bool is_open =
      design.language == Language::k2021 && request.design.language != "2021";
  try {
    return is_open
               ? find_language_and_evaluate(design, loader, options,
                                            diagnostics)
               : csg::evaluate(design.program, loader, options, diagnostics);
  } catch (const InternalError&) {
    throw;
  } catch (const FileError&) {
    throw;
  } catch (const AccessError&) {
    throw;
  } catch (const Error&) {
    return {};
  }
}

csg::Lowered lower(const csg::Tree& tree, const Request& request,
                   const Machine& machine, Readers& readers,
                   Diagnostics& diagnostics) {
  csg::Lowered lowered =
      csg::lower(tree, lower_options(request.geometry, readers), diagnostics);
  auto* scene = std::get_if<csg::Scene>(&lowered.geometry);
  if (scene != nullptr && request.geometry.axis == kAutomaticAxis) {
    turn_automatically(request, machine, *scene, diagnostics);
  }
  return lowered;
}

std::optional<slicer::HollowReport> hollow(csg::Lowered& lowered,
                                           const Request& request,
                                           const Machine& machine,
                                           Diagnostics& diagnostics) {
  if (!request.hollow || lowered.is_empty()) return std::nullopt;
  auto* scene = std::get_if<csg::Scene>(&lowered.geometry);
  if (scene == nullptr) {
    diagnostics.own_warning({}, "--hollow needs a solid; the design is flat");
    return std::nullopt;
  }
  slicer::HollowSizes sizes = *request.hollow;
  const GeometryRequest& geometry = request.geometry;
  if (!sizes.drains.empty()) {
    const Affine turn = turn_of(geometry);
    for (slicer::DrainPlace& drain : sizes.drains) {
      drain.place = geometry.scale * Vec3(turn * Vec4(drain.place, 0));
    }
  }
  return slicer::hollow_out(*scene, sizes, settings_of(request, machine),
                            diagnostics);
}

void place_on_bed(csg::Lowered& lowered, const GeometryRequest& request) {
  auto* scene = std::get_if<csg::Scene>(&lowered.geometry);
  if (scene != nullptr && request.is_placed_on_bed) {
    slicer::place_on_bed(*scene);
  }
}

slicer::Compensation compensation_of(const Request& request,
                                     const Machine& machine) {
  slicer::Compensation compensation;
  if (machine.material) compensation = machine.material->compensation;
  const CompensationRequest& asked = request.compensation;
  if (asked.contour) compensation.contour = *asked.contour;
  if (asked.foot) compensation.foot = *asked.foot;
  if (asked.bleed) compensation.bleed = *asked.bleed;
  return compensation;
}

std::optional<slicer::BleedReport> mend_bleed(
    csg::Lowered& lowered, const slicer::Settings& settings,
    slicer::Compensation& compensation, Diagnostics& diagnostics) {
  auto* scene = std::get_if<csg::Scene>(&lowered.geometry);
  if (scene != nullptr) {
    if (compensation.bleed == 0) return std::nullopt;
    return slicer::compensate_bleed(*scene, compensation.bleed, settings,
                                    diagnostics);
  }
  if (lowered.outline() != nullptr &&
      (compensation.bleed > 0 || compensation.foot.inset > 0)) {
    diagnostics.own_warning(
        {},
        "foot and bleed of the compensation need a solid; the design is "
        "flat");
  }
  compensation.foot = {};
  compensation.bleed = 0;
  return std::nullopt;
}

void judge(const csg::Lowered& lowered, const Request& request,
           Diagnostics& diagnostics) {
  if (lowered.is_empty()) throw slicer::EmptyDesign();
  if (lowered.outline() != nullptr && !holds_outlines(request.output.format)) {
    Diagnostic fault{
        Severity::kError, {}, "Current top level object is not a 3D object."};
    fault.hints = hint_of(
        "linear_extrude(height) makes a solid of an outline, and -o with .svg "
        "writes the outline");
    throw GeometryError(fault);
  }
  warn_of_geometry(lowered, request, diagnostics);
}

slicer::Settings settings_of(const Request& request, const Machine& machine) {
  slicer::Settings settings = request.job;
  if (machine.printer && machine.printer->has_panel()) {
    const Vec2 pixel = machine.printer->pixel;
    settings.print.least_area = pixel.x * pixel.y;
    settings.print.least_volume =
        settings.print.least_area * settings.layer_thickness;
  }
  const slicer::Compensation compensation = compensation_of(request, machine);
  settings.compensation = compensation.contour;
  settings.foot = compensation.foot;
  // Each layer of the foot has a row of its own in the tables of formats.
  settings.most_thickness_runs =
      slicer::most_thickness_runs(request.output.format);
  if (settings.foot.inset != 0) {
    settings.most_thickness_runs -= std::min<std::size_t>(
        settings.foot.layers, settings.most_thickness_runs - 1);
  }
  return settings;
}

ldni::LayerGrid plan(const csg::Lowered& lowered,
                     const slicer::Settings& settings) {
  const csg::Scene* const scene = lowered.scene();
  return scene == nullptr ? ldni::LayerGrid()
                          : slicer::plan_layers(*scene, settings);
}

slicer::SliceReport slice(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid,
                          const slicer::Settings& settings,
                          slicer::LayerSink& sink, const Progress& progress,
                          Diagnostics& diagnostics) {
  CountingSink counting(sink, progress);
  const plane::Region* const outline = lowered.outline();
  slicer::SliceReport report =
      outline != nullptr
          ? slicer::slice_outline(*outline, settings, counting, diagnostics)
          : slicer::slice(*lowered.scene(), grid, settings, counting,
                          diagnostics);
  counting.finish();
  return report;
}

}  // namespace lamina::compiler
