// lamina inspect: a layer file checked and listed.

#include "slicer/inspect.h"

#include <cstdio>
#include <string>

#include "cli/command.h"
#include "cli/commands/commands.h"
#include "cli/option_values.h"
#include "cli/run.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kInspectHelp =
    R"(Usage: lamina inspect FILE.slc [OPTION]...

Shows the header, the layers and the totals of a .slc file and checks its
loops: closed, without repeats, crossings and empty loops, turned as their
nesting asks for, layers rising. Ends with 1 if there is a defect.

  --all       list every layer of a long file
  --min-feature MM
              tell of walls and gaps thinner than this
  -h, --help  print this help
)";

class InspectCommand : public Command {
 public:
  std::string_view help() const override { return kInspectHelp; }

  void add_options(CLI::App& app) override {
    app.add_option("file", file_)->required();
    app.add_flag("--all", lists_all_layers_);
    add_thin_width(app, min_feature_);
  }

  int run(slicer::TemporaryFiles&, std::size_t) override {
    Terminal terminal(false);
    return run_caught(terminal, Diagnostics(), [this] { return inspect(); });
  }

 private:
  int inspect() const {
    const slicer::Inspection inspection =
        slicer::inspect_slc(file_,
                            lists_all_layers_ ? slicer::LayerList::kAll
                                              : slicer::LayerList::kSummary,
                            min_feature_);
    std::fwrite(inspection.text.data(), 1, inspection.text.size(), stdout);
    return inspection.defects == 0 ? kDone : kFault;
  }

  std::string file_;
  bool lists_all_layers_ = false;
  double min_feature_ = 0;  // [mm]; 0: thin places are not looked for
};

}  // namespace

std::unique_ptr<Command> make_inspect_command() {
  return std::make_unique<InspectCommand>();
}

}  // namespace lamina::cli
