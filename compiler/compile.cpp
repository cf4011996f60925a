#include "compiler/compile.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/ranges.h>

#include "base/text.h"
#include "base/thread_clock.h"
#include "compiler/make_rule.h"
#include "compiler/passes.h"
#include "parser/customizer/customizer.h"
#include "parser/customizer/program_printer.h"
#include "slicer/machine/printer.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

// The rule for make; null where none is asked for. It is written before the
// output, which a fault of it ends, and gets its name after the output.
std::unique_ptr<OutputFile> begin_rule(const Compilation& c) {
  if (c.request.output.dependencies.empty()) return nullptr;
  std::vector<std::string> files = c.loader.files();
  files.insert(files.end(), c.tree.files.begin(), c.tree.files.end());
  const std::string text = make_rule(c.request.output.path, files);
  std::unique_ptr<OutputFile> rule(new OutputFile(
      OutputFile::open(c.request.output.dependencies, c.temporary_files)));
  rule->write(text);
  return rule;
}

// Writes the product of a stage before layers, and the rule.
bool finish_text(const Compilation& c, std::string_view text,
                 OutputFile* rule) {
  write_file(c.request.output.path, text, c.temporary_files);
  if (rule != nullptr) rule->commit();
  return true;
}

// The formats that show a 2D design; the others are printed.
bool holds_outlines(OutputFormat format) {
  return format == OutputFormat::kSvg || format == OutputFormat::kLayersJson;
}

void require_sliceable(const Compilation& c, const csg::Lowered& lowered) {
  if (lowered.is_empty())
    throw GeometryError("Current top level object is empty.");
  if (lowered.outline() != nullptr &&
      !holds_outlines(c.request.output.format)) {
    throw GeometryError("Current top level object is not a 3D object.");
  }
}

// A file without units, or in others, makes pieces a thousand times too small
// or too large.
void warn_of_size(Compilation& c, const csg::Lowered& lowered) {
  constexpr double kSmallest = 0.25;  // mm
  constexpr double kLargest = 5000;
  if (lowered.scene() == nullptr) return;
  const Vec3 size = lowered.scene()->box.size();
  const double greatest = std::max({size.x, size.y, size.z});
  if (greatest >= kSmallest && greatest <= kLargest) return;
  c.diagnostics.own_warning(
      {}, fmt::format("the design is {:g} x {:g} x {:g} mm: are its units "
                      "millimetres?",
                      size.x, size.y, size.z));
}

// The settings of slicing that an outline has no use for. It keeps all of its
// vertices, as a tolerance of 0 asks.
std::vector<std::string_view> settings_of_solids(const Request& request) {
  const slicer::Settings& settings = request.job;
  const slicer::Settings usual;
  std::vector<std::string_view> all;
  const auto add = [&](std::string_view option, bool is_set) {
    if (is_set) all.push_back(option);
  };
  add("--layer", settings.layer_thickness != usual.layer_thickness);
  add("--adaptive", settings.cusp != usual.cusp);
  add("--heights", !settings.heights.empty());
  add("--axis", request.geometry.axis != Request().geometry.axis);
  add("--place-on-bed", request.geometry.is_placed_on_bed);
  add("--tolerance",
      settings.tolerance != usual.tolerance && settings.tolerance != 0);
  add("--ray", settings.ray_pitch != usual.ray_pitch);
  add("--contour", settings.contour != usual.contour);
  return all;
}

void warn_of_settings(Compilation& c, const csg::Lowered& lowered) {
  if (lowered.outline() == nullptr) return;
  const auto settings = settings_of_solids(c.request);
  if (settings.empty()) return;
  c.diagnostics.own_warning(
      {}, fmt::format("the design is an outline, of which {} can change "
                      "nothing",
                      fmt::join(settings, ", ")));
}

// Heights in other units, or of a design that was placed elsewhere, would make
// empty layers without a word.
void warn_of_heights(Compilation& c, const csg::Lowered& lowered) {
  const std::vector<double>& heights = c.request.job.heights;
  if (lowered.scene() == nullptr || heights.empty()) return;
  const Box3& box = lowered.scene()->box;
  if (box.is_empty()) return;
  const auto outside = static_cast<std::size_t>(std::count_if(
      heights.begin(), heights.end(),
      [&box](double z) { return z < box.low.z || z > box.high.z; }));
  if (outside == 0) return;
  c.diagnostics.own_warning(
      {}, fmt::format("{} of {} outside the design, which reaches from z {:g} "
                      "to {:g} mm",
                      outside, counted(heights.size(), "height"), box.low.z,
                      box.high.z));
}

// Whether messages end the run here, without an output.
bool ends_strictly(Compilation& c) {
  if (!c.is_strict()) return false;
  if (c.has_failed || c.diagnostics.has_errors()) return true;
  const std::size_t warnings = c.count(Severity::kWarning);
  if (warnings == 0) return false;
  c.has_failed = true;
  c.diagnostics.error(
      {}, fmt::format("{}, so nothing is written; with --no-strict it is",
                      counted(warnings, "warning")));
  return true;
}

// Passes layers on and counts them.
class CountingSink : public slicer::LayerSink {
 public:
  CountingSink(slicer::LayerSink& sink, const Progress& progress)
      : sink_(sink), progress_(progress) {}

  void begin(const Box3& box) override { sink_.begin(box); }
  void expect(std::uint32_t layers) override {
    all_ = layers;
    sink_.expect(layers);
    if (progress_) progress_(0, all_);
  }
  std::string encode(const slicer::Layer& layer) const override {
    return sink_.encode(layer);
  }
  void take(const slicer::Layer& layer) override {
    sink_.take(layer);
    if (progress_) progress_(++done_, all_);
  }
  // Fewer layers can come than were expected.
  void finish() const {
    if (progress_) progress_(all_, all_);
  }

 private:
  slicer::LayerSink& sink_;
  const Progress& progress_;
  std::uint64_t done_ = 0;
  std::uint64_t all_ = 0;
};

using slicer::OutputFormat;

// What the request promises of the contours.
std::optional<slicer::Deviation> promised_deviation(const Request& request) {
  auto deviation = slicer::promised_deviation(request.job);
  if (deviation && request.geometry.chordal_error > 0) {
    deviation->facets = request.geometry.chordal_error;
  }
  return deviation;
}

// Whether the run ends with an error though its text is complete: OpenSCAD 2026
// ends so at the first of hard warnings, 2021.01 ends well.
bool ends_hard(const Compilation& c) {
  return c.has_failed && c.request.design.has_hard_warnings &&
         c.language == Language::k2026;
}

// The printer that was asked for, else of images the usual one of the format.
std::optional<slicer::Printer> choose_printer(const Request& request,
                                              const FileAccess& access) {
  std::string name = request.output.printer;
  if (name.empty() && slicer::is_of_images(request.output.format)) {
    name = request.output.format == OutputFormat::kSl1       ? "prusa-sl1"
           : request.output.format == OutputFormat::kNanoDlp ? "wanhao-d7"
                                                             : "plain";
  }
  if (name.empty()) return std::nullopt;
  slicer::Printer printer = slicer::find_printer(name, access);
  if (request.output.mirrors_x) printer.right = -printer.right;
  if (request.output.mirrors_y) printer.up = -printer.up;
  return printer;
}

// Prusa's printers alone read the archive as it is.
void warn_of_archive(const Request& request, const Machine& machine,
                     Diagnostics& diagnostics) {
  if (request.output.format != OutputFormat::kSl1) return;
  if (machine.printer->name.starts_with("prusa-sl1")) return;
  diagnostics.own_warning(
      {}, fmt::format("an .sl1 archive for {} is for programs that convert it, "
                      "such as UVtools: the printer does not read it",
                      machine.printer->name));
}

// Exposures hold for a printer and a thickness.
void warn_of_exposure(const Request& request, const Machine& machine,
                      Diagnostics& diagnostics) {
  const auto& printer = machine.printer;
  const auto& material = machine.material;
  if (!printer || !material || !slicer::is_of_images(request.output.format))
    return;
  const auto warn = [&](const std::string& what) {
    diagnostics.own_warning(
        {}, fmt::format("the exposure of {} is for {}; a profile of your own "
                        "can have yours",
                        material->title, what));
  };
  if (material->exposure == 0) return;
  if (!material->printer.empty() && material->printer != printer->name) {
    warn(material->printer);
  } else if (material->layer_thickness > 0 &&
             material->layer_thickness != request.job.layer_thickness) {
    warn(fmt::format("layers of {:g} mm", material->layer_thickness));
  }
}

}  // namespace

bool compile(Compilation& c) {
  // Load and parse: the files of the design, then its parameter set.
  c.program = load(c);
  if (ends_strictly(c)) return false;

  // The syntax tree is written before anything is evaluated: what a design
  // does is no matter of its syntax.
  if (c.request.output.format == OutputFormat::kAst) {
    return finish_text(c, ast::print(c.program), begin_rule(c).get());
  }
  if (c.request.output.format == OutputFormat::kParam) {
    const std::filesystem::path design = c.request.design.path;
    return finish_text(c, parameters_json(c.program, design.stem().string()),
                       begin_rule(c).get());
  }

  // Evaluate: the program runs, echoes, and leaves the CSG tree.
  c.tree = evaluate(c, c.program);

  // The rule names what modules of the design read. An evaluation that an error
  // cut short does not know all of it.
  const auto rule = c.tree.root != nullptr ? begin_rule(c) : nullptr;

  if (ends_strictly(c)) return false;

  // Texts end well even where the design failed, as openscad's do; strict runs
  // have ended.
  if (c.request.output.format == OutputFormat::kEcho) {
    return finish_text(c, echo_text(c), rule.get()) && !ends_hard(c);
  }
  if (c.request.output.format == OutputFormat::kCsg) {
    return finish_text(c, csg_text(c), rule.get()) && !ends_hard(c);
  }
  if (c.has_failed) return false;

  // The output is opened first: nothing is computed for a file that cannot be.
  LayerOutput output =
      LayerOutput::open(c.request, c.temporary_files, c.diagnostics);

  // Lower: transforms, 2D parts and hulls need the whole tree, layers only the
  // leaves. The scene is turned and placed here, while it is still one thing.
  const csg::Lowered lowered = lower_tree(c);

  if (ends_strictly(c)) return false;

  // Plan, and slice layer by layer into the output.
  make_layers(c, lowered, settings_of(c.request), output.sink());
  if (ends_strictly(c)) return false;

  // Write the end of the output. It gets its name when all has gone well.
  output.finish(c.diagnostics, c.report);
  if (rule != nullptr) rule->commit();
  c.report.warnings = c.count(Severity::kWarning);
  c.report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - c.begin)
          .count();
  return true;
}

bool make_tree(Compilation& c) {
  c.program = load(c);
  c.tree = evaluate(c, c.program);
  return !c.has_failed;
}

csg::Lowered lower_tree(Compilation& c) {
  csg::Lowered lowered = lower(c);
  c.tree.drop_nodes();
  require_sliceable(c, lowered);
  warn_of_size(c, lowered);
  warn_of_settings(c, lowered);
  warn_of_heights(c, lowered);
  return lowered;
}

std::optional<csg::Lowered> make_geometry(Compilation& c) {
  if (!make_tree(c)) return std::nullopt;
  return lower_tree(c);
}

void make_layers(Compilation& c, const csg::Lowered& lowered,
                 const slicer::Settings& settings, slicer::LayerSink& sink) {
  CountingSink counting(sink, c.on_progress);

  // Plan: all layers must stand before the first one is cut.
  ldni::LayerGrid grid;
  const double plan_seconds =
      measure_seconds([&] { grid = plan(lowered, settings); });

  // Slice: in parallel, and in order.
  c.report.slice = slice(lowered, grid, settings, counting, c.diagnostics);
  c.report.slice.section_seconds += plan_seconds;
  if (const csg::Scene* scene = lowered.scene()) {
    c.report.origins = origins_of(*scene, c.report.slice.features);
    if (const auto& print = c.report.slice.print) {
      c.report.finding_origins = origins_of(*scene, print->findings);
    }
  }
  counting.finish();
}

Machine choose_machine(const Request& request, const FileAccess& access) {
  Machine machine;
  machine.printer = choose_printer(request, access);
  if (!request.output.material.empty()) {
    machine.material = slicer::find_material(request.output.material, access);
  }
  return machine;
}

LayerOutput::LayerOutput(Machine machine,
                         std::optional<slicer::Deviation> deviation,
                         std::unique_ptr<slicer::LayerWriter> writer)
    : machine_(std::make_unique<const Machine>(std::move(machine))),
      deviation_(deviation),
      writer_(std::move(writer)) {
  if (machine_->printer) {
    build_volume_ =
        std::make_unique<slicer::BuildVolumeSink>(*machine_->printer, *writer_);
  }
}

LayerOutput LayerOutput::open(const Request& request,
                              TemporaryFiles& temporary_files,
                              Diagnostics& diagnostics) {
  Machine machine = choose_machine(request, temporary_files.file_access());
  warn_of_archive(request, machine, diagnostics);
  warn_of_exposure(request, machine, diagnostics);
  const auto deviation = promised_deviation(request);
  slicer::WriterOptions options;
  options.format = request.output.format;
  if (request.output.cli_encoding) options.cli = *request.output.cli_encoding;
  if (machine.printer) options.printer = *machine.printer;
  options.exposure = slicer::exposure_of(machine.material);
  if (machine.material) options.material = machine.material->title;
  if (deviation) options.deviation = deviation->from_section();
  auto writer =
      slicer::make_layer_writer(options, request.output.path, temporary_files);
  return {std::move(machine), deviation, std::move(writer)};
}

void LayerOutput::finish(Diagnostics& diagnostics, Report& report) {
  writer_->finish(diagnostics);
  if (deviation_) deviation_->rounding = writer_->greatest_rounding();
  report.deviation = deviation_;
  report.machine = *machine_;
  report.estimate =
      slicer::estimate_print(machine_->printer, machine_->material,
                             report.slice.layers, report.slice.volume);
  report.snapped_layers = writer_->snapped_layers();
  writer_->commit();
  report.output_bytes = writer_->size();
}

}  // namespace lamina::compiler
