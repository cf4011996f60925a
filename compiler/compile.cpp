#include "compiler/compile.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "compiler/make_rule.h"
#include "csg/csg_printer.h"
#include "parser/ast_printer.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::cli {
namespace {

using slicer::OutputFormat;

// The rule for make; null where none is asked for. It is written before the
// output, which a fault of it ends, and gets its name after the output.
std::unique_ptr<OutputFile> begin_rule(Run& run) {
  if (run.options.dependencies.empty()) return nullptr;
  std::vector<std::string> files = run.loader.files();
  files.insert(files.end(), run.named_files.begin(), run.named_files.end());
  const std::string text = make_rule(run.options.output, files);
  auto rule = std::make_unique<OutputFile>(run.options.dependencies,
                                           run.temporary_files);
  rule->write(text);
  return rule;
}

// The product of a stage before layers, and the rule.
int finish_text(Run& run, std::string_view text, OutputFile* rule) {
  write_text(run, run.options.output, text);
  if (rule != nullptr) rule->commit();
  return kDone;
}

std::string csg_text(Run& run, const csg::Tree& tree) {
  if (tree.root == nullptr) return "\n";
  return csg::print_csg(tree, *csg::select_root(tree, run.diagnostics));
}

// What the options promise of the contours.
std::optional<slicer::Deviation> promised_deviation(
    const DesignOptions& options) {
  auto deviation = slicer::promised_deviation(options.settings);
  if (deviation && options.chordal_error > 0) {
    deviation->facets = options.chordal_error;
  }
  return deviation;
}

// Empty where contours are not made of samples.
std::string sampler_name(const slicer::Settings& settings) {
  if (settings.contour != slicer::ContourMode::kPaper) return {};
  switch (settings.paper.sampler) {
    case ldni::SamplerKind::kScanline:
      return "scanline";
    case ldni::SamplerKind::kGl:
      return "gl";
    case ldni::SamplerKind::kGlPeeling:
      return "gl-peeling";
  }
  return {};
}

// The panel of the printer; of formats without images an empty one.
slicer::Panel chosen_panel(const DesignOptions& options,
                           const FileAccess& access) {
  if (!slicer::is_of_images(options.format)) return {};
  const std::string usual = options.format == OutputFormat::kSl1 ? "prusa-sl1"
                            : options.format == OutputFormat::kNanoDlp
                                ? "wanhao-d7"
                                : "plain";
  slicer::Panel panel = slicer::find_panel(
      options.printer.empty() ? usual : options.printer, access);
  if (options.mirrors_x) panel.right = -panel.right;
  if (options.mirrors_y) panel.up = -panel.up;
  return panel;
}

void complete_report(Run& run) {
  run.report.wall_seconds = std::chrono::duration<double>(
                                std::chrono::steady_clock::now() - run.begin)
                                .count();
  run.report.warnings = count(run.diagnostics, Severity::kWarning);
  run.report.min_feature = run.options.settings.min_feature;
  run.report.sampler = sampler_name(run.options.settings);
}

}  // namespace

int compile(Run& run) {
  const Loaded loaded = load(run);
  // The syntax tree is written before anything is evaluated: what a design
  // does is no matter of its syntax.
  if (run.options.format == OutputFormat::kAst) {
    const auto rule = begin_rule(run);
    return finish_text(run, ast::print(loaded.program), rule.get());
  }
  Evaluated evaluated = evaluate(run, loaded.program);
  run.named_files = evaluated.tree.files;
  // A run that hard warnings cut short does not know them all.
  const auto rule = evaluated.tree.root != nullptr ? begin_rule(run) : nullptr;
  // Texts end well even where the design failed, as openscad's do.
  if (run.options.format == OutputFormat::kEcho) {
    // For what it warns of.
    if (evaluated.tree.root) csg::select_root(evaluated.tree, run.diagnostics);
    return finish_text(run, echo_text(run), rule.get());
  }
  if (run.options.format == OutputFormat::kCsg) {
    return finish_text(run, csg_text(run, evaluated.tree), rule.get());
  }
  if (loaded.has_failed || evaluated.has_failed) return kFault;

  auto deviation = promised_deviation(run.options);
  slicer::WriterOptions how;
  how.format = run.options.format;
  if (run.options.cli_encoding) how.cli = *run.options.cli_encoding;
  how.panel = chosen_panel(run.options, run.file_access());
  if (deviation) how.deviation = deviation->from_section();
  const auto writer =
      slicer::make_layer_writer(how, run.options.output, run.temporary_files);
  make_layers(run, std::move(evaluated.tree), *writer);
  writer->finish(run.diagnostics);
  if (deviation) deviation->rounding = writer->greatest_rounding();
  run.report.deviation = deviation;
  run.report.snapped_layers = writer->snapped_layers();
  writer->commit();
  if (rule != nullptr) rule->commit();
  run.report.output_bytes = writer->size();
  complete_report(run);
  return kDone;
}

void show_report(Run& run) {
  if (!slicer::is_of_layers(run.options.format)) return;
  if (!run.options.report.empty()) {
    write_text(run, run.options.report, report_json(run.report));
  }
  if (run.report.min_feature > 0) {
    run.terminal.say(feature_lines(run.report));
  }
  // The memory in it costs a small run a tenth of its time to find out.
  if (!run.options.is_quiet) {
    run.terminal.say(summary_line(run.options.output, run.report));
  }
}

}  // namespace lamina::cli
