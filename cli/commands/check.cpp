// lamina check: what would go wrong in the print of a design or of layers.

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/finding_table.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"

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

  void add_options(OptionList& options) override {
    options.word("file", request_.design.path).required();
    options.flag("--json", is_json_);
    options.texts("--allow",
                  "{islands,loose-parts,overhangs,suction-cups,resin-traps}",
                  [this](const std::string& word) { allow(word); });
    options.number("--self-supporting", "length", request_.job.self_supporting);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    note_design_option(options, request_);
  }

  void check() override {
    compiler::require_readable("check", request_.design.path);
    compiler::validate(request_);
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

  int check_print(compiler::Compilation& compilation) const {
    const auto inspection = compiler::look_at(compilation, {});
    if (!inspection) return kFault;
    const auto& [found, lines, layers] = *inspection;
    report_skipped(compilation, found.file);
    const slicer::PrintCheck& print = *found.print;
    print_out(is_json_
                  ? json_text(print_json(print, lines.findings))
                  : finding_table(print, compiler::texts_of(lines.findings)));
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
  bool is_json_ = false;
  std::set<slicer::FindingKind> allowed_;
};

}  // namespace

std::unique_ptr<Command> make_check_command() {
  return std::make_unique<CheckCommand>();
}

}  // namespace lamina::cli
