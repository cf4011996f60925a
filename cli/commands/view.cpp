// lamina view: a picture of a layer file or of a design's layers.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/file/output_file.h"
#include "base/paths.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/viewer_options.h"
#include "slicer/picture/image.h"
#include "slicer/picture/layer_picture.h"
#include "slicer/picture/sheet_picture.h"
#include "slicer/picture/stack_picture.h"
#include "slicer/picture/viewer_page.h"

namespace lamina::cli {
namespace {

constexpr double kLargestPicture = 4096;  // either way [pixels]

bool is_page(const std::string& output) { return output.ends_with(".html"); }

slicer::Camera parse_camera(const std::string& text) {
  const std::vector<double> numbers = require_numbers("--camera", text);
  require(numbers.size() == 6 || numbers.size() == 7, "--camera",
          "6 or 7 numbers were expected, not '{}'", text);
  const slicer::Camera camera = slicer::Camera::from_numbers(numbers);
  require(camera.distance > 0, "--camera", "the distance must be more than 0");
  return camera;
}

std::vector<double> parse_size(const std::string& text) {
  std::vector<double> size = require_numbers("--imgsize", text);
  const auto is_good = [](double pixels) {
    return pixels >= 1 && pixels <= kLargestPicture &&
           pixels == static_cast<unsigned>(pixels);
  };
  require(size.size() == 2 && is_good(size[0]) && is_good(size[1]), "--imgsize",
          "two whole numbers up to {} were expected, not '{}'", kLargestPicture,
          text);
  return size;
}

// The options of openscad's camera. They mean what they mean there.
class CameraOptions {
 public:
  // Outlives the list.
  void add_to(OptionList& options) {
    options.text("--camera", "numbers", [this](const std::string& text) {
      is_given_ = true;
      camera_ = parse_camera(text);
    });
    const auto add_flag = [&](const std::string& name, bool& flag) {
      options.flag(name, [this, &flag] { is_given_ = flag = true; });
    };
    add_flag("--viewall", views_all_);
    add_flag("--autocenter", centers_);
    options.choice(
        "--projection", {"p", "perspective", "o", "ortho", "orthogonal"},
        [this](const std::string& word) {
          is_given_ = true;
          projection_ = word.front() == 'o'
                            ? slicer::Camera::Projection::kOrthogonal
                            : slicer::Camera::Projection::kPerspective;
        });
    options.text("--imgsize", "width,height", [this](const std::string& text) {
      is_given_ = true;
      const std::vector<double> size = parse_size(text);
      options_.width = static_cast<unsigned>(size[0]);
      options_.height = static_cast<unsigned>(size[1]);
    });
    options.choice("--colorscheme", slicer::color_scheme_names(),
                   [this](const std::string& name) {
                     is_given_ = true;
                     options_.colors = slicer::find_color_scheme(name);
                   });
  }

  // Whether any of them was given.
  bool is_given() const { return is_given_; }

  // What they ask of a picture of a stack.
  slicer::StackOptions stack() const {
    slicer::StackOptions options = options_;
    if (camera_) options.camera = *camera_;
    options.camera.projection = projection_;
    options.shows_all = views_all_ || !camera_;
    options.centers = centers_ || !camera_;
    return options;
  }

 private:
  bool is_given_ = false;
  std::optional<slicer::Camera> camera_;
  bool views_all_ = false;
  bool centers_ = false;
  slicer::Camera::Projection projection_ =
      slicer::Camera::Projection::kPerspective;
  slicer::StackOptions options_;  // its size and its colours
};

constexpr std::string_view kViewHelp =
    R"(Usage: lamina view FILE -o PICTURE.png [OPTION]...
       lamina view FILE -o PAGE.html [OPTION]...

Draws the layers of a file (.slc, .cli, .svg, .3mf, .sl1, .goo,
.ctb, .zip, .layers.json, a folder of images), or of a .scad or .csg design with
any option of Design, Slicing and Limits (see 'lamina --help').
A page shows all layers and the solid in any browser, to leaf through, turn,
zoom and measure, and lists what 'lamina check' finds; it is one file and needs no
network.

  -o FILE           the picture or the page
  --style STYLE     sheet: single layers side by side; stack: all layers on top
                    of each other, as a solid [sheet]
  --sheet N         layers on a sheet, filled up to whole rows [20]
  --layer-number N  this layer alone, counted from 1 at the bottom
  --at Z            the layer at this height alone
  --min-feature MM  of a layer alone or a page: marks walls and gaps thinner
                    than this
  --width PIXELS    width of a sheet [1600] or of a layer alone [1200]
  --printer P, --material M, --metal M, --price PRICES
                    a page then says what the print takes, as for slicing

Of a stack, as in openscad (any of these asks for --style stack):
  --camera NUMBERS  translation, rotation and distance: x,y,z,rx,ry,rz,d, or
                    where the eye is and what it looks at: x,y,z,x,y,z
                    [the whole part from 55,0,25]
  --autocenter      look at the middle of the part
  --viewall         go where all of the part is seen
  --imgsize W,H     size of the picture [512,512]
  --projection P    p: perspective, o: orthogonal [p]
  --colorscheme N   gold, rose, silver, platinum, wax, resin, or one of
                    openscad's: Cornfield, Metallic, Sunset, Starnight,
                    BeforeDawn, Nature, DeepOcean, Solarized, Tomorrow,
                    "Tomorrow Night", Monotone [gold]

  -q, --quiet       say nothing but errors
  -h, --help        print this help
)";

enum class Style { kSheet, kStack };

struct ViewOptions {
  std::optional<Style> style;  // empty: a sheet
  std::optional<unsigned> layer_count;
  slicer::LayerPictureOptions layer;
  slicer::StackOptions stack;
  std::optional<std::size_t> layer_number;  // from 1
  std::optional<double> layer_height;       // [mm]
  std::optional<unsigned> width;            // [pixels]

  bool is_of_one_layer() const { return layer_number || layer_height; }
  // Whether any option is given that means nothing to a page.
  bool are_for_pictures() const {
    return style || layer_count || is_of_one_layer() || width;
  }
};

// The index of the layer that is asked for by its number or its height.
std::size_t find_layer(const std::vector<slicer::Layer>& layers,
                       const ViewOptions& options) {
  if (options.layer_number) {
    if (*options.layer_number > layers.size()) {
      throw GeometryError(fmt::format("there is no layer {}: there are {}",
                                      *options.layer_number, layers.size()));
    }
    return *options.layer_number - 1;
  }
  const double z = *options.layer_height;
  if (!(z >= layers.front().bottom && z <= layers.back().top)) {
    throw GeometryError(fmt::format(
        "there is no layer at z {} mm: the layers reach from {:.6g} to {:.6g}",
        z, layers.front().bottom, layers.back().top));
  }
  const auto nearest = std::min_element(
      layers.begin(), layers.end(),
      [z](const slicer::Layer& a, const slicer::Layer& b) {
        return std::abs(a.section_z - z) < std::abs(b.section_z - z);
      });
  return static_cast<std::size_t>(nearest - layers.begin());
}

slicer::Image draw_picture(const std::vector<slicer::Layer>& layers,
                           const std::string& title,
                           const ViewOptions& options) {
  if (options.is_of_one_layer()) {
    slicer::LayerPictureOptions layer = options.layer;
    layer.width = options.width.value_or(layer.width);
    return draw_layer_picture(layers, find_layer(layers, options), title,
                              layer);
  }
  if (options.style == Style::kStack) return draw_stack(layers, options.stack);
  slicer::SheetOptions sheet;
  sheet.width = options.width.value_or(sheet.width);
  sheet.layer_count = options.layer_count.value_or(sheet.layer_count);
  return draw_sheet(layers, title, sheet);
}

void write_page(const compiler::Compilation& compilation,
                const compiler::Inspection& inspection,
                const std::string& title) {
  const slicer::ViewerOptions page =
      compiler::viewer_options(compilation, inspection, title);
  compiler::write_file(compilation.request.output.path,
                       viewer_page(inspection.layers, page),
                       compilation.temporary_files);
}

int draw(compiler::Compilation& compilation, const ViewOptions& options) {
  const compiler::Request& request = compilation.request;
  const bool draws_page = is_page(request.output.path);
  const auto inspection = compiler::look_at(
      compilation,
      {.makes_graph = draws_page,
       .keeps_layers = true,
       .keeps_colors = draws_page || options.style == Style::kStack});
  if (!inspection) return kFault;
  report_skipped(compilation, inspection->found.file);
  const std::vector<slicer::Layer>& layers = inspection->layers;
  if (std::ranges::all_of(layers, [](const slicer::Layer& layer) {
        return layer.contours.points.empty();
      })) {
    throw GeometryError(
        fmt::format("{} has no contour to draw", request.design.path));
  }
  const std::string title =
      std::filesystem::path(request.design.path).filename();
  if (draws_page) {
    write_page(compilation, *inspection, title);
    return kDone;
  }
  const slicer::Image picture = draw_picture(layers, title, options);
  OutputFile output =
      OutputFile::open(request.output.path, compilation.temporary_files);
  write_png(picture, output);
  output.commit();
  return kDone;
}

class ViewCommand : public Command {
 public:
  std::string_view help() const override { return kViewHelp; }

  void add_options(OptionList& options) override {
    options.word("file", request_.design.path).required();
    options.name("-o", "file", request_.output.path).required();
    options.choice(
        "--style", {"sheet", "stack"}, [this](const std::string& style) {
          options_.style = style == "stack" ? Style::kStack : Style::kSheet;
        });
    options.whole("--sheet", options_.layer_count, 1, 400);
    const Option number = options.layer_number(options_.layer_number);
    options
        .text("--at", "height",
              [this](const std::string& text) {
                options_.layer_height = require_number("--at", text);
              })
        .excludes(number);
    options.number("--min-feature", "length", options_.layer.min_feature);
    camera_.add_to(options);
    options.whole("--width", options_.width, 200, 8000);
    add_machine_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    note_design_option(options, request_);
  }

  void check() override {
    if (camera_.is_given()) options_.style = Style::kStack;
    options_.stack = camera_.stack();

    refuse_if(!is_page(request_.output.path) &&
                  !request_.output.path.ends_with(".png"),
              "view writes .png pictures and .html pages; '{}' is neither",
              request_.output.path);
    compiler::require_readable("view", request_.design.path);
    refuse_if(options_.layer.min_feature > 0 &&
                  !is_page(request_.output.path) && !options_.is_of_one_layer(),
              "--min-feature needs --layer-number, --at or .html");
    refuse_if(options_.style == Style::kStack && options_.is_of_one_layer(),
              "a stack shows all layers, not one");
    refuse_if(options_.style == Style::kStack && options_.width,
              "a stack needs --imgsize W,H, not --width");
    refuse_if(is_page(request_.output.path) && options_.are_for_pictures(),
              "of view's own options a page takes --min-feature only");
    const compiler::OutputRequest& output = request_.output;
    refuse_if(!is_page(output.path) &&
                  !(output.printer.empty() && output.material.empty() &&
                    output.metal.empty()),
              "--printer, --material and --metal need .html");
    // The page shows what made what is found in a design.
    if (is_page(request_.output.path)) {
      request_.job.min_feature = options_.layer.min_feature;
      request_.job.finds_makers = true;
    }
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({request_.output.path});
      return draw(session.compilation, options_);
    });
  }

 private:
  compiler::Request request_;  // also names a .slc
  bool is_quiet_ = false;
  ViewOptions options_;
  CameraOptions camera_;
};

}  // namespace

std::unique_ptr<Command> make_view_command() {
  return std::make_unique<ViewCommand>();
}

}  // namespace lamina::cli
