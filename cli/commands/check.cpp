// lamina check: what would go wrong in the print of a design or of layers.

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/feature_table.h"
#include "cli/report/finding_table.h"
#include "cli/report/hidden_table.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"
#include "compiler/machine.h"
#include "slicer/machine/estimate.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kCheckHelp =
    R"(Usage: lamina check FILE... [OPTION]...

Says whether a design would print, or a file of layers (.slc, .cli, .svg,
.slices.3mf, .sl1, .goo, .ctb, .zip, .layers.json, a folder of images), and what
would go wrong. It takes the options of Design and Slicing that 'lamina --help'
lists, but --heights, and writes no file:

  loose parts    are connected to nothing that reaches the bed
  islands        begin in mid-air: nothing in the layer below holds them
  resin traps    are hollows without a way out
  suction cups   are hollows that nothing leads out of while they are built:
                 the plate or the film closes them
  overhangs      stand out over the layer below by more than a surface of 45°
                 does

Each has its layers, its place, its size and, in a design, the line that makes
it; the worst comes first. With --printer it says whether the part fits; with
--min-feature, which walls and gaps are thin: in a layer, and of a design also
in space, where they lie flat or lean. What is smaller than a pixel of
the printer (0.001 mm² where none is named) is only counted. The exit status is
1 if something would go wrong (with --fail-on, if that would), and where it is
too thin or does not fit.

  --printer P         the printer, as for slicing
  --material M, --metal M, --price PRICES
                      what it is made of, as for slicing
  --min-feature MM    report walls and gaps thinner than this
  --fail-on KINDS     of islands, loose-parts, overhangs, suction-cups and
                      resin-traps, separated by commas, or all [all]
  --self-supporting MM
                      how far a layer may stand out over the one below [as far
                      as a surface of 45° does]
  --json              print all of it as JSON, of one file
  -h, --help          print this help
)";

class CheckCommand : public Command {
 public:
  std::string_view help() const override { return kCheckHelp; }

  void add_options(OptionList& options) override {
    options.words("file", files_).required();
    options.flag("--json", is_json_);
    add_print_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    add_machine_options(options, request_);
    note_design_option(options, request_);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    for (const std::string& file : files_) {
      request_.design.path = file;
      compiler::require_readable("check", file);
      compiler::validate(request_);
    }
    refuse_if(!request_.job.heights.empty(),
              "check needs whole layers, not --heights");
    refuse_if(is_json_ && files_.size() > 1, "--json takes one file");
    request_.job.finds_makers = true;
    auto& fail_on = request_.job.print.fail_on;
    if (fail_on.empty()) fail_on = slicer::kAllFindings;
  }

  int run(const Context& context) override {
    int status = kDone;
    for (const std::string& file : files_) {
      compiler::Request request = request_;
      request.design.path = file;
      Session session(request, is_quiet_, context);
      status = std::max(status, session.run([&] {
        if (&file == &files_.front()) context.expect_outputs({"-"});
        return check_print(session.compilation);
      }));
    }
    return status;
  }

 private:
  int check_print(compiler::Compilation& compilation) const {
    const compiler::Request& request = compilation.request;
    const bool is_file =
        compiler::holds_layers(request.design.path, compilation.file_access());
    const auto inspection = compiler::look_at(
        compilation, {.min_feature = is_file ? request.job.min_feature : 0,
                      .finds_hidden = !is_file});
    if (!inspection) return kFault;
    const compiler::Machine& machine = compilation.report.machine;
    const slicer::Inspection& found = inspection->found;
    const compiler::FoundLines& lines = inspection->lines;
    report_skipped(compilation, found.file);
    const slicer::PrintCheck& print = *found.print;
    if (is_json_) {
      auto json = print_json(print, lines.findings);
      if (found.supports) {
        json["supports"] = supports_json(*found.supports, lines.contacts);
      }
      print_out(json_text(json));
    } else {
      print_out(text_of(*inspection, machine, request, !is_file));
      if (compilation.report.direction) {
        print_out(direction_line(compilation.report) + "\n");
      }
    }
    const bool fits =
        !machine.printer || slicer::fits(*machine.printer, found.box.size());
    const bool harms = !print.counts(request.job.print.fail_on).empty();
    const bool is_thin = !found.features.empty() ||
                         (inspection->hidden && !inspection->hidden->empty());
    return fits && !is_thin && !harms ? kDone : kFault;
  }

  // is_design  whether options of slicing can change how it stands
  static std::string fit_line(const slicer::Printer& printer,
                              const compiler::Request& request, Vec3 size,
                              bool is_design) {
    if (slicer::fits(printer, size)) {
      return fmt::format("fits: {} on {}\n", size_text(size), printer.title);
    }
    return fmt::format(
        "does not fit: {}\n",
        is_design ? compiler::too_large_text(printer, request.geometry, size)
                  : slicer::TooLarge(printer, size).what());
  }

  std::string text_of(const compiler::Inspection& inspection,
                      const compiler::Machine& machine,
                      const compiler::Request& request, bool is_design) const {
    const slicer::Inspection& found = inspection.found;
    std::string text;
    if (files_.size() > 1) {
      text += fmt::format("{}\n", on_one_line(request.design.path));
    }
    if (machine.printer) {
      text += fit_line(*machine.printer, request, found.box.size(), is_design);
    }
    const std::string estimate = slicer::estimate_text(
        machine,
        slicer::estimate_print(
            machine, request.job.layer_thickness, found.layers.size(),
            found.volume, slicer::part_volume(found.volume, found.supports)));
    if (!estimate.empty()) text += estimate + '\n';
    text += finding_table(*found.print,
                          compiler::texts_of(inspection.lines.findings));
    text += contact_table(found.supports,
                          compiler::texts_of(inspection.lines.contacts));
    if (request.job.min_feature > 0) {
      text += feature_table(found.features, request.job.min_feature,
                            compiler::texts_of(inspection.lines.features));
      if (is_design) {
        text += hidden_table(inspection.hidden, request.job.min_feature);
      }
    }
    return text;
  }

  std::vector<std::string> files_;
  compiler::Request request_;
  bool is_quiet_ = false;
  bool is_json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_check_command() {
  return std::make_unique<CheckCommand>();
}

}  // namespace lamina::cli
