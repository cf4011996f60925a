// lamina compare: how far two files, designs or meshes are from each other.

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/file/output_file.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/openscad.h"
#include "cli/process/streams.h"
#include "cli/report/comparison_text.h"
#include "cli/report/session.h"
#include "compiler/look_at.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/comparison.h"
#include "slicer/picture/difference_picture.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kCompareHelp =
    R"(Usage: lamina compare A B [OPTION]...
       lamina compare DESIGN --against openscad [OPTION]...

Compares the layers of files (.slc .cli .svg .3mf .sl1 .goo .ctb .zip
.layers.json, a folder of images), designs (.scad .csg), meshes (.stl .off .obj
.ply .amf .3mf), drawings (.dxf) and CAD files (.step .stp .iges .igs .brep .brp
.fcstd), in any pairing. All but files of layers are cut at the heights of the
other one; two designs at those of the first. Shows for each layer the areas that only one of
them covers, regions and holes, and the greatest distance of their contours: no
point of one is farther from the other's. Ends with 0 if all layers are within
the tolerance, with 1 if not.

  --tolerance MM      greatest distance that counts as equal [the sum of what
                      both say of their precision, 0.001 at least]
  --align             moves B first, so that the lower left corners of their
                      boxes and their lowest layers agree
  --all               list every layer, not only those that differ most
  --png FILE          draw the layer that differs most
  --layer-number N    draw this layer of the table instead
  --report FILE       write all numbers as JSON
  --against openscad  compare with what the installed openscad makes of it;
                      its version decides what '--language auto' is
  --time-limit S      seconds for openscad, after which it is ended [600]
  -q, --quiet         say nothing but errors
  -h, --help          print this help

Options of Design, Slicing and Limits are those of slicing (see 'lamina
--help'), but for --tolerance. Contours of designs keep all vertices.
)";

// A shift that is less is none [mm].
constexpr double kLeastShift = 1e-6;

constexpr double kUsualTimeLimit = 600;  // seconds
constexpr compiler::NumberLimits kTimeLimits = {
    "--time-limit", 0, 1e6, "must be from {1} to {2} s, not {0}", nullptr};
constexpr compiler::NumberLimits kTolerances = {
    "--tolerance", 0, 1e6, "must be from {1} to {2} mm, not {0}", nullptr};

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

class CompareCommand : public Command {
 public:
  std::string_view help() const override { return kCompareHelp; }

  void add_options(OptionList& options) override {
    options.word("A", a_).required();
    options.word("B", b_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    note_design_option(options, request_);
    // The words are the comparison's here.
    options.remove("--tolerance");
    request_.job.tolerance = 0;
    options.text("--tolerance", "length", [this](const std::string& text) {
      tolerance_ = require_within(kTolerances, text);
    });
    options.flag("--align", aligns_);
    options.flag("--all", lists_all_);
    options.name("--png", "file", picture_);
    options.layer_number(layer_number_).needs("--png");
    options.name("--report", "file", report_);
    options.choice("--against", {"openscad"},
                   [this](const std::string&) { is_against_openscad_ = true; });
    options
        .text("--time-limit", "seconds",
              [this](const std::string& text) {
                time_limit_ = require_within(kTimeLimits, text);
              })
        .needs("--against");
  }

  void check() override {
    refuse_if(b_.empty() && !is_against_openscad_,
              "compare needs two files, or --against openscad");
    refuse_if(!b_.empty() && is_against_openscad_,
              "--against openscad stands for the second file");
    for (const std::string& path : {a_, b_}) {
      refuse_if(
          !path.empty() && !compiler::can_compare(path),
          "'{}' is no file that compare reads (.slc .cli .svg "
          ".sl1 .goo .ctb .zip .layers.json .scad .csg .stl .off .obj .ply "
          ".amf .3mf "
          ".dxf .step .stp .iges .igs .brep .brp .fcstd)",
          path);
    }
    if (is_against_openscad_) check_openscad();
    refuse_if(request_.job.paper.sampler != ldni::SamplerKind::kScanline,
              "compare cuts at heights, which --sampler gl cannot");
    refuse_if(!picture_.empty() && !picture_.ends_with(".png"),
              "--png draws .png pictures; '{}' is none", picture_);
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    Side a;
    Side b;
    std::vector<const Diagnostics*> shown;
    return run_caught(terminal, shown, [&] {
      context.expect_outputs({is_quiet_ ? "" : "-", report_, picture_});
      std::string version;
      if (is_against_openscad_) {
        version = openscad_version(context.temporary_files);
        if (request_.design.language == "auto") {
          request_.design.language = language_of(version);
        }
      }
      shown.push_back(&open(a, a_, context));
      a.compared = compiler::open_compared(a.session->compilation);
      if (is_against_openscad_) {
        // Faults of the design come before those of openscad.
        a.compared->layers();
        const ScratchFolder folder(context.temporary_files);
        const OpenScadMesh mesh =
            render_with_openscad(a.request, time_limit_, folder);
        shown.push_back(&open(b, mesh.path, context));
        b.compared = compiler::open_openscad_mesh(
            b.session->compilation,
            fmt::format("{}, rendered in {:.1f} s", version, mesh.seconds));
        // Has it read while it is there.
        b.compared->cut({0});
      } else {
        shown.push_back(&open(b, b_, context));
        b.compared = compiler::open_compared(b.session->compilation);
      }
      if (!a.compared->can_be_cut() && !b.compared->can_be_cut()) {
        compiler::refuse_design_options(request_.design, a_);
      }
      return compare(*a.compared, *b.compared, context.temporary_files);
    });
  }

 private:
  // One of the two, and what the user sees of its compilation.
  struct Side {
    compiler::Request request;
    std::optional<Session> session;
    std::unique_ptr<compiler::Compared> compared;
  };

  // Returns the messages of the side.
  const Diagnostics& open(Side& side, const std::string& path,
                          const Context& context) const {
    side.request = compiler::request_of_side(path, request_);
    side.session.emplace(side.request, is_quiet_, context);
    return side.session->compilation.diagnostics;
  }

  void check_openscad() const {
    refuse_if(!a_.ends_with(".scad") && !a_.ends_with(".csg"),
              "--against openscad compares a design");
    refuse_if(
        request_.geometry.chordal_error > 0,
        "--chordal-error makes other facets than openscad's: give $fa and "
        "$fs by -D");
  }

  int compare(compiler::Compared& a, compiler::Compared& b,
              TemporaryFiles& temporary_files) const {
    compiler::Comparison comparison(a, b, aligns_);
    compiler::ComparisonResult result =
        comparison.run(tolerance_.value_or(comparison.usual_tolerance()));
    if (!result.is_equal() && !aligns_) result.hint = find_hint(a, b, result);
    if (!is_quiet_) print_out(comparison_text(result, lists_all_));
    if (!report_.empty()) {
      compiler::write_file(report_, comparison_json(result), temporary_files);
    }
    if (!picture_.empty()) draw(comparison, result, temporary_files);
    return result.is_equal() ? kDone : kFault;
  }

  // A shift that makes them equal, if there is one.
  static Vec3 find_hint(compiler::Compared& a, compiler::Compared& b,
                        const compiler::ComparisonResult& result) {
    try {
      const compiler::ComparisonResult aligned =
          compiler::Comparison(a, b, true).run(result.tolerance);
      const Vec3 shift = aligned.shift;
      const bool is_moved = std::abs(shift.x) > kLeastShift ||
                            std::abs(shift.y) > kLeastShift ||
                            std::abs(shift.z) > kLeastShift;
      if (is_moved && aligned.is_equal()) return shift;
    } catch (const GeometryError&) {
      // Heights do not match then: no hint.
    }
    return Vec3(0);
  }

  void draw(const compiler::Comparison& comparison,
            const compiler::ComparisonResult& result,
            TemporaryFiles& temporary_files) const {
    if (result.layers.empty()) throw GeometryError("there is no layer to draw");
    const std::size_t index =
        layer_number_ ? *layer_number_ - 1 : *result.totals.worst;
    if (index >= result.layers.size()) {
      throw GeometryError(
          fmt::format("there is no layer {} to draw: there are {}", index + 1,
                      result.layers.size()));
    }
    const slicer::Image picture = slicer::draw_difference(
        comparison.layer_a(index).contours, comparison.layer_b(index).contours,
        result.layers[index],
        {file_name(result.a.name), file_name(result.b.name)});
    OutputFile output = OutputFile::open(picture_, temporary_files);
    write_png(picture, output);
    output.commit();
  }

  compiler::Request request_;  // of designs
  bool is_quiet_ = false;
  std::string a_;
  std::string b_;                    // empty: openscad
  std::optional<double> tolerance_;  // [mm]
  bool aligns_ = false;
  bool lists_all_ = false;
  std::string picture_;                      // path; empty: none
  std::optional<std::size_t> layer_number_;  // from 1
  std::string report_;                       // path; empty: none
  bool is_against_openscad_ = false;
  double time_limit_ = kUsualTimeLimit;
};

}  // namespace

std::unique_ptr<Command> make_compare_command() {
  return std::make_unique<CompareCommand>();
}

}  // namespace lamina::cli
