// lamina inspect: layers of a file or of a design checked, measured and listed.

#include "base/paths.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/inspection_text.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kInspectHelp =
    R"(Usage: lamina inspect FILE [OPTION]...

Shows the header, the layers, the box, the volume and the weight in usual
metals of a file of layers (.slc, .cli, .svg, .3mf, .sl1, .goo, .ctb, .zip,
.layers.json, a folder of images), or of a design or mesh with the options of
Design and Slicing that 'lamina --help' lists; of a mesh (.stl, .off, .obj,
.ply, .amf, .3mf) also its vertices, triangles, components, genus and holes, as
they are in the file. Checks the loops: closed, without repeats, crossings and
empty loops, in the direction that their nesting asks for, layers one on the
other. Ends with 1 if there is a defect. Says what would go wrong in the print
as 'lamina check' does.

  --all       list every layer of a long file
  --json      print all of it as JSON
  --min-feature MM
              report walls and gaps thinner than this
  -h, --help  print this help
)";

class InspectCommand : public Command {
 public:
  std::string_view help() const override { return kInspectHelp; }

  void add_options(OptionList& options) override {
    options.word("file", request_.design.path).required();
    options.flag("--all", lists_all_layers_);
    options.flag("--json", is_json_);
    // In the layers as they are written, not by the slicer on its way.
    options.number("--min-feature", "length", min_feature_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    note_design_option(options, request_);
    options.layer_range(request_.job.written).in_group(kDesignGroup);
  }

  void check() override {
    compiler::require_readable("inspect", request_.design.path);
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({"-"});
      return inspect(session.compilation);
    });
  }

 private:
  int inspect(compiler::Compilation& compilation) const {
    auto inspection = compiler::look_at(
        compilation, {.finds_defects = true, .min_feature = min_feature_});
    if (!inspection) return kFault;
    slicer::Inspection& found = inspection->found;
    found.name = display_path(found.name);
    print_out(is_json_ ? inspection_json(found)
                       : inspection_text(found, lists_all_layers_
                                                    ? ListedLayers::kAll
                                                    : ListedLayers::kSummary));
    return found.defects == 0 ? kDone : kFault;
  }

  compiler::Request request_;
  bool is_quiet_ = false;
  bool lists_all_layers_ = false;
  bool is_json_ = false;
  double min_feature_ = 0;  // [mm]; 0: thin places are not looked for
};

}  // namespace

std::unique_ptr<Command> make_inspect_command() {
  return std::make_unique<InspectCommand>();
}

}  // namespace lamina::cli
