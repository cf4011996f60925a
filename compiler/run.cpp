#include "compiler/run.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/thread_clock.h"
#include "cli/command.h"
#include "cli/process/process_watch.h"
#include "compiler/imported_design.h"
#include "csg/boundary/move_scene.h"
#include "parser/parameter_set.h"
#include "slicer/formats/output_format.h"
#include "slicer/plan/orientation.h"
#include "slicer/plan/surface_heights.h"
#include "slicer/slice/slice.h"

namespace lamina::cli {
namespace {

using slicer::OutputFormat;

// Recursion of a design's functions ends here, long before memory does.
constexpr std::size_t kEvaluationStack = std::size_t{128} << 20;

// Runs a pass and adds the processor seconds that it takes to `seconds`. It
// works on this thread alone, beside which other runs may go on.
template <typename Pass>
auto timed(double& seconds, const Pass& pass) {
  const double begin = thread_seconds();
  auto product = pass();
  seconds += thread_seconds() - begin;
  return product;
}

// The formats that show a 2D design; the others are printed.
bool holds_outlines(OutputFormat format) {
  return format == OutputFormat::kSvg || format == OutputFormat::kLayersJson;
}

// Passes that report what they throw have had it shown already.
bool is_reported(const Diagnostics& diagnostics, const Diagnostic& thrown) {
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.message == thrown.message &&
        diagnostic.range.source == thrown.range.source &&
        diagnostic.range.begin == thrown.range.begin) {
      return true;
    }
  }
  return false;
}

}  // namespace

Run::Run(const DesignOptions& run_options, TemporaryFiles& files,
         std::size_t stack, Inbox* inbox)
    : options(run_options),
      temporary_files(files),
      evaluation_stack(std::min(stack / 2, kEvaluationStack)),
      terminal(run_options.is_quiet, inbox),
      diagnostics([this](const Diagnostic& d) { terminal.show(d); }),
      loader(sources, diagnostics, library_folders(files.file_access()),
             run_options.definitions, files.file_access()) {
  diagnostics.set_hard_warnings(run_options.has_hard_warnings);
}

void write_text(Run& run, const std::string& path, std::string_view text) {
  OutputFile output(path, run.temporary_files);
  output.write(text);
  output.commit();
}

std::size_t count(const Diagnostics& diagnostics, Severity severity) {
  std::size_t count = 0;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.severity == severity) ++count;
  }
  return count;
}

std::string echo_text(const Run& run) {
  const std::string& design = run.options.design;
  const std::size_t slash = design.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "." : design.substr(0, slash);
  return openscad_text(run.diagnostics.all(), folder);
}

[[noreturn]] void refuse_geometry(const std::string& words) {
  throw GeometryError({Severity::kError, {}, words});
}

Loaded load(Run& run) {
  const DesignOptions& options = run.options;
  try {
    return timed(run.report.load_seconds, [&]() -> Loaded {
      ast::Program program =
          is_imported(options.design)
              ? run.loader.load_text(options.design, import_of(options.design))
              : run.loader.load(options.design);
      const bool is_good =
          options.parameter_file.empty() ||
          apply_parameter_set(options.parameter_file, options.parameter_set,
                              program, run.diagnostics, run.file_access());
      return {std::move(program), !is_good};
    });
  } catch (const SyntaxError&) {
    if (run.options.format == OutputFormat::kEcho) {
      write_text(run, run.options.output,
                 echo_text(run) + fmt::format("Can't parse file '{}'!\n\n",
                                              run.options.design));
    }
    throw;
  }
}

Evaluated evaluate(Run& run, const ast::Program& program) {
  csg::EvaluateOptions options;
  options.stack_bytes = run.evaluation_stack;
  // As openscad sets it for each of its outputs.
  const bool has_preview = run.options.format == OutputFormat::kCsg ||
                           run.options.format == OutputFormat::kEcho;
  options.preview = has_preview && (run.options.render.empty() ||
                                    !run.options.preview.empty());
  options.seed = run.options.seed;
  options.check_parameters = run.options.checks_parameters;
  options.check_ranges = run.options.checks_parameter_ranges;
  options.max_depth = run.options.max_depth;
  options.max_leaves = run.options.max_leaves;
  run.typesetter.add_fonts(run.loader.fonts());
  options.text_measurer = &run.typesetter;
  const std::size_t errors = count(run.diagnostics, Severity::kError);
  return timed(run.report.evaluate_seconds, [&]() -> Evaluated {
    try {
      csg::Tree tree =
          csg::evaluate(program, run.loader, options, run.diagnostics);
      const bool has_failed = count(run.diagnostics, Severity::kError) > errors;
      return {std::move(tree), has_failed};
    } catch (const InternalError&) {
      throw;
    } catch (const FileError&) {
      throw;
    } catch (const AccessError&) {
      throw;
    } catch (const Error&) {
      return {{}, true};
    }
  });
}

std::optional<csg::Tree> load_tree(Run& run) {
  const Loaded loaded = load(run);
  Evaluated evaluated = evaluate(run, loaded.program);
  if (loaded.has_failed || evaluated.has_failed) return std::nullopt;
  return std::move(evaluated.tree);
}

namespace {

csg::LowerOptions lower_options(Run& run) {
  const DesignOptions& options = run.options;
  csg::LowerOptions how;
  if (options.axis != kAutomaticAxis) {
    how.world_from_design = slicer::turn_to_axis(options.axis);
  }
  how.chordal_error = options.chordal_error;
  how.typesetter = &run.typesetter;
  how.file_access = &run.file_access();
  how.scale = options.scale;
  return how;
}

// What is asked of the scene as a whole, and needs its surface.
void place(Run& run, csg::Scene& scene) {
  if (run.options.axis == kAutomaticAxis) {
    const slicer::OrientationChoice choice =
        slicer::choose_orientation(scene, run.options.settings.layer_thickness);
    csg::move_scene(scene, slicer::turn_to_axis(choice.all[choice.best].axis),
                    Vec3(0));
    run.terminal.say(slicer::orientation_table(choice));
  }
  if (run.options.is_placed_on_bed) slicer::place_on_bed(scene);
}

}  // namespace

csg::Lowered lower(Run& run, csg::Tree& tree) {
  // Lowering comes before slicing because transforms, 2D parts and hulls need
  // the whole tree, layers only the leaves.
  csg::Lowered lowered = timed(run.report.lower_seconds, [&] {
    return csg::lower(tree, lower_options(run), run.diagnostics);
  });
  tree.drop_nodes();
  if (lowered.is_empty()) refuse_geometry("Current top level object is empty.");
  if (auto* scene = std::get_if<csg::Scene>(&lowered.geometry)) {
    place(run, *scene);
  }
  return lowered;
}

void slice(Run& run, const csg::Lowered& lowered,
           const slicer::Settings& settings, slicer::LayerSink& sink) {
  if (const planar::Region* outline = lowered.outline()) {
    run.report.slice =
        slicer::slice_outline(*outline, settings, sink, run.diagnostics);
    return;
  }
  const csg::Scene& scene = *lowered.scene();
  ProgressSink progress(sink, run.terminal.progress());
  run.report.slice = slicer::slice(scene, settings, progress, run.diagnostics);
  run.report.origins = origins_of(scene, run.report.slice.features);
}

void make_layers(Run& run, csg::Tree tree, slicer::LayerSink& sink) {
  const csg::Lowered lowered = lower(run, tree);
  if (lowered.outline() != nullptr && !holds_outlines(run.options.format)) {
    refuse_geometry("Current top level object is not a 3D object.");
  }
  slicer::Settings settings = run.options.settings;
  settings.most_thickness_runs =
      slicer::most_thickness_runs(run.options.format);
  slice(run, lowered, settings, sink);
}

int run_caught(Terminal& terminal, const Diagnostics& diagnostics,
               const std::function<int()>& work) {
  try {
    return work();
  } catch (const InternalError& error) {
    terminal.show(
        {Severity::kError,
         {},
         fmt::format("internal error, please report: {}", error.what())});
  } catch (const Error& error) {
    if (!is_reported(diagnostics, error.diagnostic())) {
      terminal.show(error.diagnostic());
    }
  } catch (const std::range_error& error) {
    // Of csg/plane/clip.h, past lowering: no place in the design is at hand.
    terminal.show({Severity::kError, {}, error.what()});
  } catch (const std::bad_alloc&) {
    terminal.show({Severity::kError, {}, out_of_memory_text()});
  } catch (const std::exception& error) {
    terminal.show(
        {Severity::kError,
         {},
         fmt::format("internal error, please report: {}", error.what())});
  }
  return kFault;
}

}  // namespace lamina::cli
