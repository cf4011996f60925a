// lamina sprue: a design with sprues, as a design.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/process/exit_status.h"
#include "cli/report/session.h"
#include "compiler/compile.h"
#include "compiler/sprues.h"
#include "compiler/stage_text.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kSprueHelp =
    R"(Usage: lamina sprue DESIGN -o SPRUED.scad [OPTION]...

Writes DESIGN with sprues as an OpenSCAD design: it includes or imports DESIGN
and adds a line for each sprue, which you can edit, move or leave out. A sprue
runs straight from a common root to the heaviest place, and is 1.4 times as wide
there as that place is thick; where thin places cut other heavy ones off, these
get sprues of their own. They come out where $visible is not set.

The written design is measured, too: what metal that enters by the root would
still reach only through thinner places is listed.

  -o FILE             the design to write
  --sprue             =D for the root's diameter in mm, =D,LENGTH for how far
                      from the piece it is at least, too; add ,disc for a plate
                      for the piece to stand on [1.8 times the thickness, 5]

All options of Design but -p and -P are those of 'lamina --help', and so are
--chordal-error and --decimate: the written design has the piece as it is drawn.
Slicing takes --sprue, too, and adds the same sprues in the run; turn, scale and
hold what is written with 'lamina supports SPRUED.scad' or as you slice it.

  -q, --quiet         print errors only
  -h, --help          print this help
)";

class SprueCommand : public Command {
 public:
  std::string_view help() const override { return kSprueHelp; }

  void add_options(OptionList& options) override {
    request_.sprues.emplace();
    options.word("design", request_.design.path).required();
    options.name("-o", "file", output_).required();
    add_design_options(options, request_, is_quiet_);
    add_facet_options(options, request_);
    add_sprue_option(options, request_);
  }

  void check() override {
    refuse_if(!output_.ends_with(".scad"),
              "sprue writes a .scad design, but '{}' does not end in .scad",
              output_);
    refuse_if(!request_.design.parameter_file.empty(),
              "sprue takes values from -D, not from -p and -P");
    refuse_layers(request_.design.path);
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({output_});
      const auto lowered = compiler::make_geometry(session.compilation);
      const auto& plan = session.compilation.report.sprues;
      if (!lowered || !plan) return kFault;
      compiler::write_file(
          output_,
          compiler::design_that_takes(request_.design, folder_of(output_)) +
              session.compilation.request.design.appended,
          context.temporary_files);
      tell(session.terminal, *plan,
           compiler::unfed_by(*lowered->scene(), plan->root));
      return kDone;
    });
  }

 private:
  void tell(Terminal& terminal, const slicer::SpruePlan& plan,
            const std::vector<slicer::Pool>& unfed) const {
    std::string text =
        fmt::format("{}: {}", on_one_line(output_), slicer::size_text(plan));
    for (const slicer::Sprue& sprue : plan.sprues) {
      text += fmt::format(
          "\n{:.2f} mm wide, on {:.2f} mm, at {}: feeds {:.3g} mm³{}",
          sprue.diameter, sprue.thickness, place_text(sprue.exit), sprue.feeds,
          sprue.at.empty() ? "" : ", at " + sprue.at);
    }
    const std::string left = slicer::unfed_text(unfed);
    terminal.say(text + "\nwith them: " +
                 (left.empty() ? "all is fed from the root" : left));
  }

  compiler::Request request_;
  std::string output_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_sprue_command() {
  return std::make_unique<SprueCommand>();
}

}  // namespace lamina::cli
