// The program lamina: a list of passes over a design.
//
//   load ─▶ parse ─▶ evaluate ─▶ lower ─▶ slice ─▶ write
//
// Nothing is computed here. Each pass appends to Diagnostics and throws where
// the run must end; here, and only here, messages are printed, exceptions
// caught, and exit statuses chosen.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "cli/make_rule.h"
#include "cli/options.h"
#include "cli/report.h"
#include "cli/run.h"
#include "cli/run_on_stack.h"
#include "cli/terminal.h"
#include "csg/eval/csg_printer.h"
#include "parser/ast_printer.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/formats/output_file.h"
#include "slicer/formats/slc_reader.h"
#include "slicer/image.h"
#include "slicer/inspect.h"
#include "slicer/picture.h"

namespace lamina::cli {
namespace {

using slicer::OutputFormat;

constexpr int kDone = 0;
constexpr int kFault = 1;

// The rule for make, if one is asked for. `tree` is null before evaluation.
void write_dependencies(Run& run, const csg::Tree* tree) {
  if (run.options.dependencies.empty()) return;
  std::vector<std::string> files = run.loader.files();
  if (tree != nullptr) {
    files.insert(files.end(), tree->files.begin(), tree->files.end());
  }
  write_text(run, run.options.dependencies,
             make_rule(run.options.output, files));
}

std::string csg_text(Run& run, const csg::Tree& tree) {
  if (tree.root == nullptr) return "\n";
  return csg::print_csg(tree, *csg::select_root(tree, run.diagnostics));
}

// What the options promise of the contours.
std::optional<slicer::Deviation> promised_deviation(
    const DesignOptions& options) {
  const slicer::Settings& settings = options.settings;
  if (settings.contour == slicer::ContourMode::kPaper) return std::nullopt;
  slicer::Deviation deviation;
  deviation.simplification = settings.tolerance;
  if (settings.compensation != 0) {
    deviation.compensation = slicer::Compensator::kArcTolerance;
  }
  if (options.chordal_error > 0) deviation.facets = options.chordal_error;
  return deviation;
}

// Empty where contours are not made of samples.
std::string sampler_name(const slicer::Settings& settings) {
  if (settings.contour != slicer::ContourMode::kPaper) return {};
  switch (settings.sampler) {
    case slicer::SamplerKind::kScanline:
      return "scanline";
    case slicer::SamplerKind::kGl:
      return "gl";
    case slicer::SamplerKind::kGlPeeling:
      return "gl-peeling";
  }
  return {};
}

// The panel of the printer; of formats without images an empty one.
slicer::Panel chosen_panel(const DesignOptions& options) {
  if (!slicer::is_of_images(options.format)) return {};
  const std::string usual =
      options.format == OutputFormat::kSl1 ? "prusa-sl1" : "plain";
  slicer::Panel panel =
      slicer::find_panel(options.printer.empty() ? usual : options.printer);
  if (options.mirrors_x) panel.right = -panel.right;
  if (options.mirrors_y) panel.up = -panel.up;
  return panel;
}

void finish_report(Run& run, std::uint64_t output_bytes) {
  run.report.wall_seconds = std::chrono::duration<double>(
                                std::chrono::steady_clock::now() - run.begin)
                                .count();
  run.report.warnings = count(run.diagnostics, Severity::kWarning);
  run.report.min_feature = run.options.settings.min_feature;
  run.report.sampler = sampler_name(run.options.settings);
  if (!run.options.report.empty()) {
    write_text(run, run.options.report, report_json(run.report));
  }
  if (run.report.min_feature > 0) {
    run.terminal.say(feature_lines(run.report));
  }
  // The memory in it costs a small run a tenth of its time to find out.
  if (!run.options.is_quiet) {
    run.terminal.say(
        summary_line(run.options.output, output_bytes, run.report));
  }
}

int compile(Run& run) {
  const Loaded loaded = load(run);
  // The syntax tree is written before anything is evaluated: what a design
  // does is no matter of its syntax.
  if (run.options.format == OutputFormat::kAst) {
    write_dependencies(run, nullptr);
    write_text(run, run.options.output, ast::print(loaded.program));
    return kDone;
  }
  Evaluated evaluated = evaluate(run, loaded.program);
  // A run that hard warnings cut short does not know them all.
  if (evaluated.tree.root != nullptr) write_dependencies(run, &evaluated.tree);
  // Texts end well even where the design failed, as openscad's do.
  if (run.options.format == OutputFormat::kEcho) {
    // For what it warns of.
    if (evaluated.tree.root) csg::select_root(evaluated.tree, run.diagnostics);
    write_text(run, run.options.output, echo_text(run));
    return kDone;
  }
  if (run.options.format == OutputFormat::kCsg) {
    write_text(run, run.options.output, csg_text(run, evaluated.tree));
    return kDone;
  }
  if (loaded.has_failed || evaluated.has_failed) return kFault;

  auto deviation = promised_deviation(run.options);
  slicer::WriterOptions how;
  how.format = run.options.format;
  if (run.options.cli_encoding) how.cli = *run.options.cli_encoding;
  how.panel = chosen_panel(run.options);
  if (deviation) how.deviation = deviation->from_section();
  const auto writer =
      slicer::make_layer_writer(how, run.options.output, run.temporary_files);
  make_layers(run, std::move(evaluated.tree), *writer);
  writer->finish(run.diagnostics);
  if (deviation) deviation->rounding = writer->greatest_rounding();
  run.report.deviation = deviation;
  run.report.snapped_layers = writer->snapped_layers();
  writer->commit();
  finish_report(run, writer->size());
  return kDone;
}

class LayerList : public slicer::LayerSink {
 public:
  void take(const slicer::Layer& layer) override { layers.push_back(layer); }
  std::vector<slicer::Layer> layers;
};

// All layers of a file or of a design; no value where the design failed.
std::optional<std::vector<slicer::Layer>> layers_of(Run& run) {
  LayerList list;
  if (run.options.design.ends_with(".slc")) {
    slicer::SlcReader reader(run.options.design);
    slicer::SlcLayer layer;
    while (reader.read_layer(layer)) list.take(to_layer(layer));
    return std::move(list.layers);
  }
  const Loaded loaded = load(run);
  Evaluated evaluated = evaluate(run, loaded.program);
  if (loaded.has_failed || evaluated.has_failed) return std::nullopt;
  make_layers(run, std::move(evaluated.tree), list);
  return std::move(list.layers);
}

int view(Run& run, const slicer::PictureOptions& options) {
  const auto layers = layers_of(run);
  if (!layers) return kFault;
  if (std::all_of(layers->begin(), layers->end(), [](const auto& layer) {
        return layer.contours.points.empty();
      })) {
    refuse_geometry(
        fmt::format("{} has no contour to draw", run.options.design));
  }
  const std::size_t slash = run.options.design.rfind('/');
  const std::string title =
      run.options.design.substr(slash == std::string::npos ? 0 : slash + 1);
  slicer::OutputFile output(run.options.output, run.temporary_files);
  write_png(draw_picture(*layers, title, options), output);
  output.commit();
  return kDone;
}

int inspect(const InspectOptions& options) {
  const slicer::Inspection inspection = slicer::inspect_slc(
      options.file,
      options.lists_all_layers ? slicer::LayerList::kAll
                               : slicer::LayerList::kSummary,
      options.min_feature);
  std::fwrite(inspection.text.data(), 1, inspection.text.size(), stdout);
  return inspection.defects == 0 ? kDone : kFault;
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

// Runs `work` and turns what it throws into messages and a status.
template <typename Work>
int run_caught(Terminal& terminal, const Diagnostics& diagnostics,
               const Work& work) {
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
  } catch (const std::bad_alloc&) {
    terminal.show({Severity::kError, {}, "out of memory"});
  } catch (const std::exception& error) {
    terminal.show(
        {Severity::kError,
         {},
         fmt::format("internal error, please report: {}", error.what())});
  }
  return kFault;
}

int run_command(const Command& command, slicer::TemporaryFiles& files,
                std::size_t stack) {
  if (const auto* options = std::get_if<InspectOptions>(&command)) {
    Terminal terminal(false);
    return run_caught(terminal, Diagnostics(),
                      [&] { return inspect(*options); });
  }
  if (const auto* options = std::get_if<ViewOptions>(&command)) {
    Run run(options->design, files, stack);
    return run_caught(run.terminal, run.diagnostics,
                      [&] { return view(run, options->picture); });
  }
  Run run(std::get<DesignOptions>(command), files, stack);
  return run_caught(run.terminal, run.diagnostics,
                    [&] { return compile(run); });
}

}  // namespace
}  // namespace lamina::cli

int main(int argc, char** argv) {
  using namespace lamina;
  const cli::Command command = cli::parse_command_line(argc, argv);
  if (const auto* exit = std::get_if<cli::Exit>(&command)) {
    std::fputs(exit->text.c_str(), exit->status == 0 ? stdout : stderr);
    return exit->status;
  }
  slicer::TemporaryFiles temporary_files;
  return cli::run_on_stack(temporary_files, [&](std::size_t stack) {
    return cli::run_command(command, temporary_files, stack);
  });
}
