#include "cli/options/design_options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "cli/options/contradictions.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
namespace {

std::vector<double> parse_heights(const std::string& option,
                                  std::string_view text) {
  std::vector<double> heights = require_numbers(option, text);
  const auto fall = std::adjacent_find(heights.begin(), heights.end(),
                                       std::greater_equal<>());
  require(fall == heights.end(), option, "heights must rise");
  return heights;
}

// Facets that are nearer to the curve than this are finer than the distance
// below which two samples count as one.
constexpr double kLeastChordalError = 1e-6;  // mm

// Beyond these a design is not shrunk or enlarged but mistyped.
constexpr double kLeastScale = 0.001;
constexpr double kGreatestScale = 1000;

// No beam is wider, and no resin bleeds farther [mm].
constexpr double kGreatestCompensation = 100;

double parse_scale(const std::string& text) {
  require(!text.ends_with('%'), "--scale",
          "a factor was expected, such as 1.02 for a print 2% larger, not '{}'",
          text);
  return require_within("--scale", text, kLeastScale, kGreatestScale, "");
}

// A whole number from 1 to `most`. CLI11's own checks make a text of their
// bounds at every start.
void add_count(CLI::App& app, const std::string& name, std::uint32_t most,
               std::uint32_t& target) {
  add_text(app, name, "number", [=, &target](const std::string& text) {
    const double count = require_within(name, text, 1, most, "");
    require(count == std::floor(count), name,
            "a whole number was expected, not '{}'", text);
    target = static_cast<std::uint32_t>(count);
  });
}

// Options that are added while it lives are of that group.
class GroupOfDesigns {
 public:
  explicit GroupOfDesigns(CLI::App& app)
      : defaults_(*app.option_defaults()), group_(defaults_.get_group()) {
    defaults_.group(kDesignGroup);
  }
  ~GroupOfDesigns() { defaults_.group(group_); }
  GroupOfDesigns(const GroupOfDesigns&) = delete;
  GroupOfDesigns& operator=(const GroupOfDesigns&) = delete;

 private:
  CLI::OptionDefaults& defaults_;
  const std::string group_;
};

}  // namespace

void add_design_options(CLI::App& app, compiler::Request& request,
                        bool& is_quiet) {
  add_count(app, "--max-depth", csg::kMostNestedCalls,
            request.design.max_depth);
  add_count(app, "--max-leaves", 1'000'000'000, request.design.max_leaves);
  app.add_flag("--hardwarnings", request.design.has_hard_warnings);
  app.add_flag("-q,--quiet", is_quiet);

  const GroupOfDesigns group(app);
  const auto define = [&request](const std::vector<std::string>& definitions) {
    for (const std::string& definition : definitions) {
      request.design.definitions += definition + ";\n";
    }
  };
  make_repeatable(
      app.add_option_function<std::vector<std::string>>("-D", define)
          ->type_name("NAME=VALUE"));
  CLI::Option* set = app.add_option("-P", request.design.parameter_set);
  CLI::Option* file =
      add_name(app, "-p", "file", request.design.parameter_file);
  set->type_name("set")->needs(file);
  file->needs(set);
  add_switch(app, "--check-parameters", request.design.checks_parameters);
  add_switch(app, "--check-parameter-ranges",
             request.design.checks_parameter_ranges);
  app.add_flag("--render", request.design.render);
  app.add_flag("--preview", request.design.preview);
  app.add_option("--seed", request.design.seed)->type_name("number");
  add_choice(app, "--language", {"auto", "2021", "2026"},
             [&](const std::string& word) { request.design.language = word; });
}

void add_slicing_options(CLI::App& app, compiler::Request& request) {
  slicer::Settings& settings = request.job;
  add_count(app, "--threads", 1024, settings.threads);

  const GroupOfDesigns group(app);
  add_text(app, "--layer", "length", [&](const std::string& text) {
    settings.layer_thickness = require_positive("--layer", text);
  });
  add_text(app, "--adaptive", "length", [&](const std::string& text) {
    settings.cusp = require_positive("--adaptive", text);
  });
  add_text(app, "--max-layer", "length", [&](const std::string& text) {
    settings.greatest_thickness = require_positive("--max-layer", text);
  });
  add_text(app, "--heights", "list", [&](const std::string& text) {
    settings.heights = parse_heights("--heights", text);
  });
  add_text(app, "--chordal-error", "length", [&](const std::string& text) {
    request.geometry.chordal_error = require_number("--chordal-error", text);
    require(request.geometry.chordal_error >= kLeastChordalError,
            "--chordal-error", "must be at least 0.000001 mm");
  });
  add_text(app, "--decimate", "length", [&](const std::string& text) {
    request.geometry.decimation = require_number("--decimate", text);
    require(request.geometry.decimation >= kLeastChordalError, "--decimate",
            "must be at least 0.000001 mm");
  });
  // Two names of one thing: what simplification is for, and what it promises.
  add_text(
      app, "--tolerance,--simplify", "length", [&](const std::string& text) {
        settings.tolerance = require_number("--tolerance", text);
        require(settings.tolerance >= 0, "--tolerance", "must not be negative");
      });
  add_text(app, "--compensate", "length", [&](const std::string& text) {
    settings.compensation =
        require_within("--compensate", text, -kGreatestCompensation,
                       kGreatestCompensation, " mm");
  });
  add_text(app, "--scale", "factor", [&](const std::string& text) {
    request.geometry.scale = parse_scale(text);
  });
  add_text(app, "--ray", "length", [&](const std::string& text) {
    settings.ray_pitch = text == "auto" ? 0 : require_positive("--ray", text);
  });
  add_choice(app, "--axis", {"z", "x", "y", "-x", "-y", "-z", "auto"},
             [&](const std::string& axis) { request.geometry.axis = axis; });
  app.add_flag("--place-on-bed", request.geometry.is_placed_on_bed);
  add_choice(
      app, "--contour", {"faithful", "paper"}, [&](const std::string& mode) {
        settings.contour = mode == "paper" ? slicer::ContourMode::kPaper
                                           : slicer::ContourMode::kFaithful;
      });
  add_choice(app, "--boxes", {"local", "global"}, [&](const std::string& mode) {
    settings.paper.boxes =
        mode == "global" ? ldni::BoxMode::kGlobal : ldni::BoxMode::kLocal;
  });
  const auto& samplers = ldni::kSamplerNames;
  add_choice(app, "--sampler", {samplers.begin(), samplers.end()},
             [&](const std::string& kind) {
               settings.paper.sampler = static_cast<ldni::SamplerKind>(
                   std::ranges::find(samplers, kind) - samplers.begin());
             });
}

void note_design_option(CLI::App& app, std::string& given) {
  app.parse_complete_callback([&app, &given] {
    for (const CLI::Option* const option : app.get_options()) {
      if (option->get_group() != kDesignGroup || option->count() == 0) continue;
      given = option->get_name();
      return;
    }
  });
}

void add_machine_options(CLI::App& app, compiler::Request& request) {
  add_name(app, "--printer", "printer", request.output.printer);
  add_name(app, "--material", "material", request.output.material);
}

void add_output_options(CLI::App& app, compiler::Request& request,
                        OutputOptions& options) {
  add_name(app, "--export-format", "format", options.export_format);
  add_choice(app, "--cli", {"binary", "ascii"},
             [&request](const std::string& word) {
               request.output.cli_encoding = word == "ascii"
                                                 ? slicer::CliEncoding::kAscii
                                                 : slicer::CliEncoding::kBinary;
             });
  CLI::Option* strict = app.add_flag_callback(
      "--strict", [&request] { request.output.is_strict = true; });
  app.add_flag_callback("--no-strict",
                        [&request] { request.output.is_strict = false; })
      ->excludes(strict);
  add_machine_options(app, request);
  add_choice(app, "--mirror", {"x", "y", "xy"},
             [&request](const std::string& axes) {
               request.output.mirrors_x = axes != "y";
               request.output.mirrors_y = axes != "x";
             });
  add_name(app, "--report", "file", options.report);
  add_thin_width(app, request.job.min_feature);
  add_layer_range(app, request.job.written);
}

void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output) {
  const slicer::FormatChoice choice = slicer::choose_output_format(
      options.export_format.empty() ? output : options.export_format);
  if (!choice.format) {
    throw UsageError(choice.complaint, choice.is_known ? kFault : kUsageFault);
  }
  request.output.format = *choice.format;
  request.job.finds_makers = !options.report.empty();
  refuse_contradictions(request.job);
  refuse_misfits(request, !options.report.empty());
}

}  // namespace lamina::cli
