// lamina check: what would go wrong in the print of a design or of layers.

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/contradictions.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/finding_table.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/compile.h"
#include "compiler/inspect_file.h"
#include "compiler/passes.h"
#include "slicer/formats/layer_reader.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kCheckHelp =
    R"(Usage: lamina check FILE [OPTION]...

Says what would go wrong in the print of a .scad or .csg design, with any option
that slicing has, or of a file of layers (.slc, .cli, .svg, .3mf, .sl1, .zip,
.layers.json, a folder of images):

  islands        begin in mid-air: nothing in the layer below holds them
  loose parts    hang together with nothing that reaches the bed
  overhangs      stand out over the layer below by more than a surface of 45°
                 does
  suction cups   hollows that nothing leads out of while they are built: the
                 plate or the film closes them
  resin traps    hollows that nothing leads out of at all

with layers, places, sizes and, of a design, the lines that made them. Ends with
1 if there is any. What is too small to matter is counted apart.

  --allow KIND        islands, loose-parts, overhangs, suction-cups or
                      resin-traps do no harm; may be repeated
  --self-supporting MM
                      how far a layer may stand out over the one below [as far
                      as a surface of 45° does]
  --json              print all of it as JSON
  -h, --help          print this help
)";

constexpr std::array<std::string_view, slicer::kFindingKinds> kKindWords = {
    "islands", "loose-parts", "overhangs", "suction-cups", "resin-traps"};

class CheckCommand : public Command {
 public:
  std::string_view help() const override { return kCheckHelp; }

  void add_options(CLI::App& app) override {
    app.add_option("file", request_.design.path)->required();
    app.add_flag("--json", is_json_);
    make_repeatable(app.add_option_function<std::vector<std::string>>(
                           "--allow",
                           [this](const std::vector<std::string>& words) {
                             for (const auto& word : words) allow(word);
                           })
                        ->type_name("{islands,loose-parts,overhangs,"
                                    "suction-cups,resin-traps}"));
    add_text(app, "--self-supporting", "length", [this](const auto& text) {
      request_.job.self_supporting =
          require_positive("--self-supporting", text);
    });
    add_design_options(app, request_, is_quiet_);
    add_slicing_options(app, request_);
    note_design_option(app, design_option_);
  }

  void check() override {
    require_readable("check", request_.design.path);
    refuse_contradictions(request_.job);
    refuse_if(!request_.job.heights.empty(),
              "check needs whole layers, not --heights");
    request_.job.finds_makers = true;
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({"-"});
      return check_print(session.compilation);
    });
  }

 private:
  void allow(const std::string& word) {
    const auto* const found = std::ranges::find(kKindWords, word);
    require(found != kKindWords.end(), "--allow",
            "islands, loose-parts, overhangs, suction-cups or resin-traps was "
            "expected, not '{}'",
            word);
    allowed_.insert(
        static_cast<slicer::FindingKind>(found - kKindWords.begin()));
  }

  // Whether the design or the file could be looked at.
  bool look(compiler::Compilation& compilation) const {
    if (slicer::is_readable_layer_file(request_.design.path,
                                       compilation.file_access())) {
      refuse_design_option(design_option_, request_.design.path);
      const slicer::Inspection found = compiler::inspect_file(
          request_.design.path,
          {.finds_defects = false,
           .self_supporting = request_.job.self_supporting},
          compilation.file_access());
      compilation.report.slice.print = found.print;
      tell_left_out(compilation, found.file);
      return true;
    }
    const auto lowered = compiler::make_geometry(compilation);
    if (!lowered) return false;
    slicer::LayerDrain drain;
    compiler::make_layers(compilation, *lowered,
                          compiler::settings_of(request_), drain);
    return true;
  }

  int check_print(compiler::Compilation& compilation) const {
    if (!look(compilation)) return kFault;
    print_out(is_json_ ? json_text(print_json(compilation.report))
                       : finding_lines(compilation));
    const slicer::PrintCheck& print = *compilation.report.slice.print;
    return std::ranges::any_of(print.findings,
                               [&](const slicer::Finding& finding) {
                                 return !finding.is_minor &&
                                        !allowed_.contains(finding.kind);
                               })
               ? kFault
               : kDone;
  }

  compiler::Request request_;
  bool is_quiet_ = false;
  std::string design_option_;  // the first that was given, or none
  bool is_json_ = false;
  std::set<slicer::FindingKind> allowed_;
};

}  // namespace

std::unique_ptr<Command> make_check_command() {
  return std::make_unique<CheckCommand>();
}

}  // namespace lamina::cli
