// lamina compare: how far two files, designs or meshes are from each other.

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/file/output_file.h"
#include "cli/commands/commands.h"
#include "cli/options/contradictions.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/openscad.h"
#include "cli/process/streams.h"
#include "cli/report/compared.h"
#include "cli/report/comparison.h"
#include "cli/report/comparison_text.h"
#include "cli/report/session.h"
#include "compiler/passes.h"
#include "slicer/picture/difference_picture.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kCompareHelp =
    R"(Usage: lamina compare A B [OPTION]...
       lamina compare DESIGN --against openscad [OPTION]...

Compares the layers of files (.slc .cli .svg .3mf .sl1 .zip .layers.json, a
folder of images), designs (.scad .csg), meshes (.stl .off .obj .ply .amf
.3mf), drawings (.dxf) and CAD files (.step .stp .iges .igs .brep .brp .fcstd),
in any pairing. All but files of layers are cut at the heights of the other one; two
designs at those of the first. Shows for each layer the areas that only one of
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
constexpr double kGreatestTimeLimit = 1e6;
constexpr double kGreatestTolerance = 1e6;  // mm

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

class CompareCommand : public Command {
 public:
  std::string_view help() const override { return kCompareHelp; }

  void add_options(CLI::App& app) override {
    app.add_option("A", a_)->required();
    app.add_option("B", b_);
    add_design_options(app, request_, is_quiet_);
    add_slicing_options(app, request_);
    note_design_option(app, design_option_);
    // The words are the comparison's here.
    app.remove_option(app.get_option("--tolerance"));
    request_.job.tolerance = 0;
    add_text(app, "--tolerance", "length", [this](const std::string& text) {
      tolerance_ =
          require_within("--tolerance", text, 0, kGreatestTolerance, " mm");
    });
    app.add_flag("--align", aligns_);
    app.add_flag("--all", lists_all_);
    add_name(app, "--png", "file", picture_);
    app.add_option("--layer-number", layer_number_)
        ->check(CLI::PositiveNumber)
        ->type_name("number")
        ->needs("--png");
    add_name(app, "--report", "file", report_);
    add_choice(app, "--against", {"openscad"},
               [this](const std::string&) { is_against_openscad_ = true; });
    add_text(app, "--time-limit", "seconds", [this](const std::string& text) {
      time_limit_ =
          require_within("--time-limit", text, 0, kGreatestTimeLimit, " s");
    })->needs("--against");
  }

  void check() override {
    refuse_if(b_.empty() && !is_against_openscad_,
              "compare needs two files, or --against openscad");
    refuse_if(!b_.empty() && is_against_openscad_,
              "--against openscad stands for the second file");
    for (const std::string& path : {a_, b_}) {
      refuse_if(
          !path.empty() && !can_compare(path),
          "'{}' is no file that compare reads (.slc .cli .svg "
          ".sl1 .zip .layers.json .scad .csg .stl .off .obj .ply .amf .3mf "
          ".dxf .step .stp .iges .igs .brep .brp .fcstd)",
          path);
    }
    if (is_against_openscad_) check_openscad();
    refuse_if(request_.job.paper.sampler != ldni::SamplerKind::kScanline,
              "compare cuts at heights, which --sampler gl cannot");
    refuse_if(!picture_.empty() && !picture_.ends_with(".png"),
              "--png draws .png pictures; '{}' is none", picture_);
    refuse_contradictions(request_.job);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    return run_caught(terminal, Diagnostics(), [&] {
      try {
        context.expect_outputs({is_quiet_ ? "" : "-", report_, picture_});
        std::string version;
        if (is_against_openscad_) {
          version = openscad_version(context.temporary_files);
          if (request_.design.language == "auto") {
            request_.design.language = language_of(version);
          }
        }
        const auto a = open_compared(a_, request_, is_quiet_, context);
        // Faults of the design come before those of openscad.
        if (is_against_openscad_) a->layers();
        const auto b = is_against_openscad_
                           ? open_openscad(a_, request_, version, time_limit_,
                                           is_quiet_, context)
                           : open_compared(b_, request_, is_quiet_, context);
        if (!a->can_be_cut() && !b->can_be_cut()) {
          refuse_design_option(design_option_, a_);
        }
        return compare(*a, *b, context.temporary_files);
      } catch (const ShownFault&) {
        return kFault;
      }
    });
  }

 private:
  void check_openscad() const {
    refuse_if(!a_.ends_with(".scad") && !a_.ends_with(".csg"),
              "--against openscad compares a design");
    refuse_if(
        request_.geometry.chordal_error > 0,
        "--chordal-error makes other facets than openscad's: give $fa and "
        "$fs by -D");
  }

  int compare(Compared& a, Compared& b, TemporaryFiles& temporary_files) const {
    Comparison comparison(a, b, aligns_);
    ComparisonResult result =
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
  static Vec3 find_hint(Compared& a, Compared& b,
                        const ComparisonResult& result) {
    try {
      const ComparisonResult aligned =
          Comparison(a, b, true).run(result.tolerance);
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

  void draw(const Comparison& comparison, const ComparisonResult& result,
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
  std::string design_option_;  // the first that was given, or none
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
