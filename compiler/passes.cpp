#include "compiler/passes.h"

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/thread_clock.h"
#include "csg/boundary/move_scene.h"
#include "csg/csg_printer.h"
#include "parser/customizer/definitions.h"
#include "parser/customizer/parameter_set.h"
#include "slicer/plan/orientation.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

// Runs a pass and adds the processor seconds that it takes to `seconds`. It
// works on this thread alone, beside which other compilations may go on.
template <typename Pass>
auto timed(double& seconds, const Pass& pass) {
  const double begin = thread_seconds();
  auto product = pass();
  seconds += thread_seconds() - begin;
  return product;
}

ast::Program read_design(const Request& request, Loader& loader) {
  if (request.design.text)
    return loader.load_text(request.design.path, *request.design.text);
  if (is_imported(request.design.path)) {
    return loader.load_text(request.design.path,
                            import_of(request.design.path));
  }
  return loader.load(request.design.path);
}

// What only a later version than 2021.01 can parse was not written for it.
Language choose_language(Compilation& c) {
  if (c.request.design.language == "2021") return Language::k2021;
  if (c.request.design.language == "2026") return Language::k2026;
  const std::optional<NewerSyntax>& newer = c.loader.newer_syntax();
  if (!newer) return Language::k2021;
  const SourceRange& range = newer->range;
  c.diagnostics.own_remark(
      {},
      fmt::format("read as OpenSCAD 2026 ({}:{}: {})",
                  display_path(range.source->path()),
                  range.source->line_column(range.begin).line, newer->what));
  return Language::k2026;
}

// False where the set cannot be applied, which is reported.
bool apply_parameters(Compilation& c, ast::Program& program) {
  const Request& request = c.request;
  const auto apply = [&](const ParameterSet& set) {
    return apply_parameter_set(set, program, c.language, c.diagnostics);
  };
  if (request.design.parameters) return apply(*request.design.parameters);
  if (request.design.parameter_file.empty()) return true;
  try {
    return apply(
        ParameterSets::read(request.design.parameter_file, c.file_access())
            .values_of(request.design.parameter_set));
  } catch (const FileError& fault) {
    c.diagnostics.report(fault.diagnostic());
    return false;
  }
}

csg::EvaluateOptions evaluate_options(Compilation& c) {
  const Request& request = c.request;
  csg::EvaluateOptions options;
  options.language = c.language;
  options.stack_bytes = c.evaluation_stack;
  // As openscad sets it for each of its outputs.
  const bool has_preview = request.output.format == OutputFormat::kCsg ||
                           request.output.format == OutputFormat::kEcho;
  options.preview = has_preview && (request.design.render.empty() ||
                                    !request.design.preview.empty());
  options.seed = request.design.seed;
  options.check_parameters = request.design.checks_parameters;
  options.check_ranges = request.design.checks_parameter_ranges;
  options.max_depth = request.design.max_depth;
  options.max_leaves = request.design.max_leaves;
  options.chordal_error =
      (request.geometry.chordal_error > 0 ? request.geometry.chordal_error
                                          : csg::kChordalErrorOfParts) /
      request.geometry.scale;
  options.text_measurer = &c.typesetter;
  return options;
}

csg::LowerOptions lower_options(Compilation& c) {
  const Request& request = c.request;
  csg::LowerOptions options;
  if (request.geometry.axis != kAutomaticAxis) {
    options.world_from_design = slicer::turn_to_axis(request.geometry.axis);
  }
  options.chordal_error = request.geometry.chordal_error;
  options.decimation = request.geometry.decimation;
  options.module_folders = module_folders_of(request);
  options.typesetter = &c.typesetter;
  options.cad_reader = &c.cad_reader;
  options.file_access = &c.file_access();
  options.scale = request.geometry.scale;
  return options;
}

// Moves the scene as a whole, which needs its surface.
void place(Compilation& c, csg::Scene& scene) {
  const Request& request = c.request;
  if (request.geometry.axis == kAutomaticAxis) {
    const slicer::OrientationChoice choice =
        slicer::choose_orientation(scene, request.job.layer_thickness);
    csg::move_scene(scene, slicer::turn_to_axis(choice.all[choice.best].axis),
                    Vec3(0));
    std::istringstream table(slicer::orientation_table(choice));
    for (std::string line; std::getline(table, line);) {
      c.diagnostics.report({Severity::kPlain, {}, line});
    }
  }
  if (request.geometry.is_placed_on_bed) slicer::place_on_bed(scene);
}

}  // namespace

ast::Program load(Compilation& c) {
  const Request& request = c.request;
  try {
    return timed(c.report.load_seconds, [&] {
      ast::Program program = read_design(request, c.loader);
      c.language = choose_language(c);
      check_definitions(program, c.loader, c.diagnostics);
      if (!apply_parameters(c, program)) c.has_failed = true;
      return program;
    });
  } catch (const SyntaxError&) {
    if (request.output.format == OutputFormat::kEcho) {
      write_file(request.output.path,
                 echo_text(c) + fmt::format("Can't parse file '{}'!\n\n",
                                            request.design.path),
                 c.temporary_files);
    }
    throw;
  }
}

csg::Tree evaluate(Compilation& c, const ast::Program& program) {
  c.typesetter.add_fonts(c.loader.fonts());
  const std::size_t errors = c.count(Severity::kError);
  return timed(c.report.evaluate_seconds, [&]() -> csg::Tree {
    try {
      csg::Tree tree =
          csg::evaluate(program, c.loader, evaluate_options(c), c.diagnostics);
      if (c.count(Severity::kError) > errors) c.has_failed = true;
      return tree;
    } catch (const InternalError&) {
      throw;
    } catch (const FileError&) {
      throw;
    } catch (const AccessError&) {
      throw;
    } catch (const Error&) {
      c.has_failed = true;
      return {};
    }
  });
}

csg::Lowered lower(Compilation& c) {
  csg::Lowered lowered = timed(c.report.lower_seconds, [&] {
    return csg::lower(c.tree, lower_options(c), c.diagnostics);
  });
  if (auto* scene = std::get_if<csg::Scene>(&lowered.geometry)) {
    place(c, *scene);
  }
  return lowered;
}

slicer::Settings settings_of(const Request& request) {
  slicer::Settings settings = request.job;
  settings.most_thickness_runs =
      slicer::most_thickness_runs(request.output.format);
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
                          slicer::LayerSink& sink, Diagnostics& diagnostics) {
  if (const plane::Region* outline = lowered.outline()) {
    return slicer::slice_outline(*outline, settings, sink, diagnostics);
  }
  return slicer::slice(*lowered.scene(), grid, settings, sink, diagnostics);
}

std::string echo_text(Compilation& c) {
  // For what the selection warns of.
  if (c.tree.root != nullptr) csg::select_root(c.tree, c.diagnostics);
  const std::string& design = c.request.design.path;
  const std::size_t slash = design.rfind('/');
  return openscad_text(c.diagnostics.all(), slash == std::string::npos
                                                ? "."
                                                : design.substr(0, slash));
}

std::string csg_text(Compilation& c) {
  if (c.tree.root == nullptr) return "\n";
  return csg::print_csg(c.tree, *csg::select_root(c.tree, c.diagnostics));
}

void write_file(const std::string& path, std::string_view text,
                TemporaryFiles& temporary_files) {
  OutputFile output = OutputFile::open(path, temporary_files);
  output.write(text);
  output.commit();
}

}  // namespace lamina::compiler
