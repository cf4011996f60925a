#include "cli/options/design_options.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
namespace {

// The words of a list, as CLI11 takes them.
template <typename Words>
std::vector<std::string> texts(const Words& words) {
  return {words.begin(), words.end()};
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
  add_count(app, "--max-depth", request.design.max_depth);
  add_count(app, "--max-leaves", request.design.max_leaves);
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
  add_choice(app, "--language", texts(compiler::kLanguageWords),
             [&](const std::string& word) { request.design.language = word; });
}

void add_slicing_options(CLI::App& app, compiler::Request& request) {
  slicer::Settings& settings = request.job;
  add_count(app, "--threads", settings.threads);

  const GroupOfDesigns group(app);
  add_number(app, "--layer", "length", settings.layer_thickness);
  add_number(app, "--adaptive", "length", settings.cusp);
  add_number(app, "--max-layer", "length", settings.greatest_thickness);
  add_text(app, "--heights", "list", [&](const std::string& text) {
    settings.heights = require_numbers("--heights", text);
  });
  add_number(app, "--chordal-error", "length", request.geometry.chordal_error);
  add_number(app, "--decimate", "length", request.geometry.decimation);
  // Two names of one thing: what simplification is for, and what it promises.
  add_number(app, "--tolerance,--simplify", "length", settings.tolerance);
  add_number(app, "--compensate", "length", settings.compensation);
  add_text(app, "--scale", "factor", [&](const std::string& text) {
    require(
        !text.ends_with('%'), "--scale",
        "a factor was expected, such as 1.02 for a print 2% larger, not '{}'",
        text);
    request.geometry.scale = require_within("--scale", text);
  });
  add_text(app, "--ray", "length", [&](const std::string& text) {
    settings.ray_pitch = text == "auto" ? 0 : require_within("--ray", text);
  });
  add_choice(app, "--axis", texts(compiler::kAxisWords),
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
  // gl-peeling is another name of gl, from when gl was a method of its own.
  add_choice(app, "--sampler", {"scanline", "gl", "gl-peeling"},
             [&](const std::string& kind) {
               settings.paper.sampler = kind == "scanline"
                                            ? ldni::SamplerKind::kScanline
                                            : ldni::SamplerKind::kGl;
             });
}

void note_design_option(CLI::App& app, compiler::Request& request) {
  app.parse_complete_callback([&app, &request] {
    for (const CLI::Option* const option : app.get_options()) {
      if (option->get_group() != kDesignGroup || option->count() == 0) continue;
      request.design.given_option = option->get_name();
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
  add_number(app, "--min-feature", "length", request.job.min_feature);
  add_layer_range(app, request.job.written);
}

void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output) {
  const slicer::FormatChoice choice = slicer::choose_output_format(
      options.export_format.empty() ? output : options.export_format);
  if (!choice.format && choice.is_known) throw FileError(choice.complaint);
  refuse_if(!choice.format, "{}", choice.complaint);
  request.output.format = *choice.format;
  request.job.finds_makers = !options.report.empty();
  refuse_if(
      !slicer::is_of_layers(request.output.format) && !options.report.empty(),
      "--report needs layers");
  compiler::validate(request);
}

}  // namespace lamina::cli
