// lamina supports: a design with supports, as a design.

#include "compiler/supports.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/process/exit_status.h"
#include "cli/report/finding_table.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"
#include "compiler/stage_text.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kSupportsHelp =
    R"(Usage: lamina supports DESIGN -o SUPPORTED.scad [OPTION]...

Writes DESIGN with supports as an OpenSCAD design: it includes or imports DESIGN
and adds a line for each support, which you can edit, move or leave out. A
comment after each names the line of DESIGN that it supports. Slice it with the
same --axis, --orient, --turn, --hollow and --layer.

The supported design is sliced and judged: the exit status is 1 if something
would still begin in mid-air, or reach out farther than a support holds.

  -o FILE             the design to write
  --supports          how thick the tips are that touch the part: =light for
                      0.25 mm, =medium 0.3, =heavy 0.4 or a diameter; add
                      ,raft to join the feet with a raft [that of the material,
                      or medium]
  --support-on LINES  support only what these lines make: 12, or lib.scad:12,
                      separated by commas
  --no-support-on LINES
                      add no supports to what these lines make

All options of Design but -p and -P, and all of Slicing, are those of
'lamina --help'.

  -q, --quiet         print errors only
  -h, --help          print this help
)";

class SupportsCommand : public Command {
 public:
  std::string_view help() const override { return kSupportsHelp; }

  void add_options(OptionList& options) override {
    request_.supports = slicer::SupportSizes{.tip = 0};
    options.word("design", request_.design.path).required();
    options.name("-o", "file", output_).required();
    add_print_options(options, request_);
    options.remove("--min-feature");
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  void check() override {
    refuse_if(!output_.ends_with(".scad"),
              "supports writes a .scad design, but '{}' does not end in .scad",
              output_);
    refuse_if(!request_.design.parameter_file.empty(),
              "supports takes values from -D, not from -p and -P");
    refuse_layers(request_.design.path);
    compiler::validate(request_);
    request_.job.finds_makers = true;
    auto& fail_on = request_.job.print.fail_on;
    if (!fail_on.empty()) return;
    fail_on = {slicer::FindingKind::kIsland, slicer::FindingKind::kLoosePart,
               slicer::FindingKind::kOverhang};
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({output_});
      const auto whole = compiler::look_at(session.compilation, {});
      const auto& plan = session.compilation.report.supports;
      if (!whole || !plan) return kFault;
      compiler::write_file(
          output_, text_with(session.compilation.request.design.appended),
          context.temporary_files);
      if (session.compilation.report.direction) {
        session.terminal.say(direction_line(session.compilation.report));
      }
      return tell(session.terminal, *plan, *whole);
    });
  }

 private:
  // added  sprues and supports
  std::string text_with(const std::string& added) const {
    // A design cannot take anything from what it includes.
    const std::string hollow = request_.hollow
                                   ? fmt::format(
                                         "// Hollow where it is sliced with "
                                         "--hollow {:g}.\n",
                                         request_.hollow->wall)
                                   : "";
    return hollow +
           compiler::design_that_takes(request_.design, folder_of(output_)) +
           added;
  }

  int tell(Terminal& terminal, const slicer::SupportPlan& plan,
           const compiler::Inspection& whole) const {
    terminal.say(
        fmt::format("{}: {}", on_one_line(output_), slicer::size_text(plan)));
    const slicer::PrintCheck& print = *whole.found.print;
    const bool hangs = !print.counts(request_.job.print.fail_on).empty();
    std::string text =
        finding_table(print, compiler::texts_of(whole.lines.findings));
    text.pop_back();
    terminal.say(text);
    return hangs || !plan.unheld.empty() || !plan.unwanted.empty() ? kFault
                                                                   : kDone;
  }

  compiler::Request request_;
  std::string output_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_supports_command() {
  return std::make_unique<SupportsCommand>();
}

}  // namespace lamina::cli
