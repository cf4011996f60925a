#include "compiler/compile.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/child_process.h"
#include "base/text.h"
#include "base/thread_clock.h"
#include "compiler/layer_output.h"
#include "compiler/make_rule.h"
#include "compiler/orient.h"
#include "compiler/sprues.h"
#include "compiler/stage_text.h"
#include "compiler/supports.h"
#include "csg/lower/emptiness.h"
#include "slicer/casting/sprue_text.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

// Runs a pass and adds the processor seconds that it takes to `seconds`. It
// works on this thread and its child processes alone, beside which other
// compilations may go on.
template <typename Pass>
auto timed(double& seconds, const Pass& pass) {
  const auto now = [] {
    return thread_seconds() + thread_seconds_of_children();
  };
  const double begin = now();
  auto product = pass();
  seconds += now() - begin;
  return product;
}

// Does what finds that a design is nothing, or too large for the printer, and
// says why it is, or what helps.
template <typename Work>
auto explained(const Compilation& c, const Work& work) {
  try {
    return work();
  } catch (const slicer::EmptyDesign& empty) {
    Diagnostic fault = empty.diagnostic();
    fault.hints = c.emptiness;
    throw GeometryError(std::move(fault));
  } catch (const slicer::TooLarge& large) {
    throw GeometryError(too_large_text(*c.report.machine.printer,
                                       c.request.geometry, large.size));
  }
}

// Whether it matters to the output how the design lies.
bool is_turned(const Request& request) {
  return slicer::is_of_layers(request.output.format) || request.output.dump ||
         request.supports;
}

// Slices the design as it would lie in many directions, if one is to be found.
void choose_direction(Compilation& c) {
  if (c.request.geometry.searched_direction == 0 || !is_turned(c.request)) {
    return;
  }
  c.on_pass("finding how it should lie");
  c.report.direction =
      find_direction(c.request, c.evaluation_stack, c.temporary_files);
  c.request.geometry.searched_direction = 0;
  if (c.report.direction) c.request.geometry.up = c.report.direction->up;
}

// Measures the design's thickness to see where metal must flow in.
void add_sprues(Compilation& c) {
  if (!c.request.sprues) return;
  c.on_pass("finding sprues");
  c.report.sprues = plan_sprues(c.request, c.evaluation_stack,
                                c.temporary_files, c.diagnostics);
  c.request.sprues.reset();
  if (!c.report.sprues) return;
  c.request.design.appended += slicer::sprue_text(*c.report.sprues);
}

// Slices the design without supports to see where they must stand.
void add_supports(Compilation& c) {
  if (!c.request.supports) return;
  c.on_pass("finding supports");
  c.report.supports = plan_supports(c.request, c.evaluation_stack,
                                    c.temporary_files, c.diagnostics);
  if (!c.report.supports) return;
  c.request.design.appended +=
      support_lines(*c.report.supports, c.request.geometry);
}

void load_design(Compilation& c) {
  add_sprues(c);
  choose_direction(c);
  add_supports(c);
  if (!c.is_read()) read_design(c);
  set_parameters(c.request.design, c.file_access(), c.design, c.diagnostics);
  if (!c.design.has_parameters) c.has_failed = true;
}

void evaluate_design(Compilation& c) {
  c.on_pass("evaluating");
  const std::size_t errors = c.count(Severity::kError);
  c.tree = timed(c.report.evaluate_seconds, [&] {
    return evaluate(c.design, c.request, c.loader, c.readers,
                    c.evaluation_stack, c.diagnostics);
  });
  if (c.tree.root == nullptr || c.count(Severity::kError) > errors) {
    c.has_failed = true;
  }
}

// Whether the run ends with an error though its text is complete: OpenSCAD 2026
// ends so at the first of hard warnings, 2021.01 ends well.
bool ends_hard(const Compilation& c) {
  return c.has_failed && c.request.design.has_hard_warnings &&
         c.design.language == Language::k2026;
}

// The rule for make; null where none is asked for. It is written before the
// output, which a fault of it ends, and gets its name after the output.
std::unique_ptr<OutputFile> begin_rule(const Compilation& c) {
  const OutputRequest& output = c.request.output;
  if (output.dependencies.empty()) return nullptr;
  std::vector<std::string> files = c.loader.files();
  files.insert(files.end(), c.tree.files.begin(), c.tree.files.end());
  const std::string text = make_rule(output.path, files);
  std::unique_ptr<OutputFile> rule(
      new OutputFile(OutputFile::open(output.dependencies, c.temporary_files)));
  rule->write(text);
  return rule;
}

// Writes a text instead of layers, and the rule.
void write_text(const Compilation& c, std::string_view text, OutputFile* rule) {
  c.on_pass("");
  write_file(c.request.output.path, text, c.temporary_files);
  if (rule != nullptr) rule->commit();
}

// Writes one layer between two stages, and the rule. Returns false where
// messages end the run.
bool write_dump(Compilation& c, OutputFile* rule) {
  const csg::Lowered lowered = lower_tree(c);
  if (ends_strictly(c)) return false;
  const OutputRequest& output = c.request.output;
  const std::string dump = slicer::dump_layer(
      *lowered.scene(), plan(lowered, settings_of(c.request, c.report.machine)),
      {*output.dump, *output.dump_height, slicer::is_named(output.path, ".svg"),
       &line_text});
  write_text(c, dump, rule);
  return true;
}

}  // namespace

bool compile(Compilation& c) {
  const Request& request = c.request;
  const OutputFormat format = request.output.format;

  // Load and parse: the files of the design, then its parameter set.
  try {
    load_design(c);
  } catch (const SyntaxError&) {
    if (format == OutputFormat::kEcho) {
      write_file(request.output.path, text_of_syntax_error(c),
                 c.temporary_files);
    }
    throw;
  }
  if (ends_strictly(c)) return false;

  // The syntax tree is written before anything is evaluated: what a design
  // does is not a matter of its syntax.
  if (format == OutputFormat::kAst || format == OutputFormat::kParam) {
    const auto rule = begin_rule(c);
    write_text(c, stage_text(c), rule.get());
    return true;
  }

  // Evaluate: the program runs, echoes, and leaves the CSG tree.
  evaluate_design(c);

  // The rule names what modules of the design read. An evaluation that an error
  // cut short does not know all of it.
  const auto rule = c.tree.root != nullptr ? begin_rule(c) : nullptr;

  if (ends_strictly(c)) return false;

  // Texts end well even where the design failed, as openscad's do; strict runs
  // have ended.
  if (!slicer::is_of_layers(format)) {
    write_text(c, stage_text(c), rule.get());
    return !ends_hard(c);
  }
  if (c.has_failed) return false;

  c.report.machine = choose_machine(request.output, c.file_access());

  // A look inside: one layer as a stage before layers has it.
  if (request.output.dump) return write_dump(c, rule.get());

  // The output is opened first: nothing is computed for a file that cannot be.
  LayerOutput output = LayerOutput::open(request, c.report.machine,
                                         c.temporary_files, c.diagnostics);

  // Lower: transforms, 2D parts and hulls need the whole tree, layers only the
  // leaves. The scene is turned, hollowed, placed and compensated for bleeding
  // light here, while it is still one thing.
  const csg::Lowered lowered = lower_tree(c);

  if (ends_strictly(c)) return false;

  // Plan, and slice layer by layer into the output.
  c.report.slice = make_layers(
      c, lowered, settings_of(request, c.report.machine), output.sink());
  c.report.lines = find_lines(lowered, c.report.slice);
  if (ends_strictly(c) || ends_on_findings(c)) return false;

  // Write the end of the output. It gets its name when all has gone well.
  output.finish(c.diagnostics, c.report);
  if (rule != nullptr) rule->commit();
  c.report.warnings = c.count(Severity::kWarning);
  c.report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - c.begin)
          .count();
  return true;
}

bool has_refused_warnings(Diagnostics& diagnostics) {
  const std::vector<Diagnostic>& all = diagnostics.all();
  const auto warnings = static_cast<std::size_t>(
      std::ranges::count(all, Severity::kWarning, &Diagnostic::severity));
  if (warnings == 0) return false;
  const std::string first =
      std::ranges::find(all, Severity::kWarning, &Diagnostic::severity)
          ->message;
  diagnostics.error(
      {}, fmt::format("not written: {} (first: {}); --no-strict writes it",
                      counted(warnings, "warning"), first));
  return true;
}

bool ends_strictly(Compilation& c) {
  if (!c.is_strict()) return false;
  if (c.has_failed || c.diagnostics.has_errors()) return true;
  c.has_failed = has_refused_warnings(c.diagnostics);
  return c.has_failed;
}

bool ends_on_findings(Compilation& c) {
  const auto& print = c.report.slice.print;
  if (!print) return false;
  const std::string counts = print->counts(c.request.job.print.fail_on);
  if (counts.empty()) return false;
  c.has_failed = true;
  c.diagnostics.error({}, fmt::format("not written: {} (--fail-on)", counts));
  return true;
}

void read_design(Compilation& c) {
  c.on_pass("reading");
  c.design = timed(c.report.load_seconds, [&] {
    return read(c.request.design, c.loader, c.diagnostics);
  });
}

bool make_tree(Compilation& c) {
  load_design(c);
  evaluate_design(c);
  return !c.has_failed;
}

csg::Lowered lower_tree(Compilation& c) {
  c.on_pass("making the solid");
  csg::Lowered lowered = timed(c.report.lower_seconds, [&] {
    return lower(c.tree, c.request, c.report.machine, c.readers, c.diagnostics);
  });
  if (c.request.hollow) {
    c.on_pass("hollowing");
    c.report.hollow = timed(c.report.lower_seconds, [&] {
      return hollow(lowered, c.request, c.report.machine, c.diagnostics);
    });
  }
  place_on_bed(lowered, c.request.geometry);
  c.report.compensation = compensation_of(c.request, c.report.machine);
  c.report.bleed = timed(c.report.lower_seconds, [&] {
    return mend_bleed(lowered, settings_of(c.request, c.report.machine),
                      c.report.compensation, c.diagnostics);
  });
  c.emptiness = csg::why_empty(c.tree);
  c.tree.drop_nodes();
  explained(c, [&] { judge(lowered, c.request, c.diagnostics); });
  return lowered;
}

std::optional<csg::Lowered> make_geometry(Compilation& c) {
  if (!make_tree(c)) return std::nullopt;
  return lower_tree(c);
}

slicer::SliceReport make_layers(Compilation& c, const csg::Lowered& lowered,
                                const slicer::Settings& settings,
                                slicer::LayerSink& sink) {
  // Plan: all layers must be known before the first one is cut.
  c.on_pass("planning layers");
  const ldni::LayerGrid grid = timed(c.report.plan_seconds, [&] {
    return explained(c, [&] { return plan(lowered, settings); });
  });

  // Slice: in parallel, and in order.
  return explained(c, [&] {
    return slice(lowered, grid, settings, sink, c.on_progress, c.diagnostics);
  });
}

}  // namespace lamina::compiler
