// lamina view: a picture of a layer file or of a design's layers.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/commands.h"
#include "cli/contradictions.h"
#include "cli/design_options.h"
#include "cli/option_values.h"
#include "cli/run.h"
#include "slicer/formats/output_file.h"
#include "slicer/formats/output_format.h"
#include "slicer/formats/slc_reader.h"
#include "slicer/image.h"
#include "slicer/picture.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kViewHelp =
    R"(Usage: lamina view FILE -o PICTURE.png [OPTION]...

Draws the layers of a .slc file, or of a .scad or .csg design with any option
of Design and Slicing (see 'lamina --help').

  -o FILE         the picture
  --style STYLE   sheet: single layers side by side; stack: all layers on top
                  of each other, as a solid [sheet]
  --layers N      layers on a sheet, filled up to whole rows [20]
  --width PIXELS  width of the picture [1600]
  -q, --quiet     say nothing but errors
  -h, --help      print this help
)";

class LayerList : public slicer::LayerSink {
 public:
  void take(const slicer::Layer& layer) override { layers.push_back(layer); }
  std::vector<slicer::Layer> layers;
};

// All layers of a file or of a design; no value where the design failed.
std::optional<std::vector<slicer::Layer>> layers_of(Run& run) {
  LayerList list;
  if (run.options.design.ends_with(".slc")) {
    slicer::SlcReader reader(run.options.design);
    slicer::SlcLayer layer;
    while (reader.read_layer(layer)) list.take(to_layer(layer));
    return std::move(list.layers);
  }
  const Loaded loaded = load(run);
  Evaluated evaluated = evaluate(run, loaded.program);
  if (loaded.has_failed || evaluated.has_failed) return std::nullopt;
  make_layers(run, std::move(evaluated.tree), list);
  return std::move(list.layers);
}

int draw(Run& run, const slicer::PictureOptions& options) {
  const auto layers = layers_of(run);
  if (!layers) return kFault;
  if (std::all_of(layers->begin(), layers->end(), [](const auto& layer) {
        return layer.contours.points.empty();
      })) {
    refuse_geometry(
        fmt::format("{} has no contour to draw", run.options.design));
  }
  const std::size_t slash = run.options.design.rfind('/');
  const std::string title =
      run.options.design.substr(slash == std::string::npos ? 0 : slash + 1);
  slicer::OutputFile output(run.options.output, run.temporary_files);
  write_png(draw_picture(*layers, title, options), output);
  output.commit();
  return kDone;
}

class ViewCommand : public Command {
 public:
  std::string_view help() const override { return kViewHelp; }

  void add_options(CLI::App& app) override {
    app.add_option("file", design_.design)->required();
    app.add_option("-o", design_.output)->type_name("file")->required();
    add_choice(
        app, "--style", {"sheet", "stack"}, [this](const std::string& style) {
          picture_.style = style == "stack" ? slicer::PictureStyle::kStack
                                            : slicer::PictureStyle::kSheet;
        });
    app.add_option("--layers", picture_.layer_count)
        ->check(CLI::Range(1U, 400U))
        ->type_name("number");
    app.add_option("--width", picture_.width)
        ->check(CLI::Range(200U, 8000U))
        ->type_name("number");
    add_design_options(app, design_);
    add_slicing_options(app, design_);
  }

  void check() override {
    if (!design_.output.ends_with(".png")) {
      throw UsageError(fmt::format("view draws .png pictures; '{}' is none",
                                   design_.output));
    }
    const std::string& file = design_.design;
    if (slicer::is_named_as_layers(file) && !file.ends_with(".slc")) {
      throw UsageError(fmt::format(
          "view reads layers from .slc only, and designs; not '{}'", file));
    }
    if (const char* contradiction = find_contradiction(design_.settings)) {
      throw UsageError(contradiction);
    }
  }

  int run(slicer::TemporaryFiles& temporary_files, std::size_t stack) override {
    Run run(design_, temporary_files, stack);
    return run_caught(run.terminal, run.diagnostics,
                      [&] { return draw(run, picture_); });
  }

 private:
  DesignOptions design_;  // also names a .slc
  slicer::PictureOptions picture_;
};

}  // namespace

std::unique_ptr<Command> make_view_command() {
  return std::make_unique<ViewCommand>();
}

}  // namespace lamina::cli
