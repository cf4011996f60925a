#include "cli/options.h"

#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <double-conversion/double-conversion.h>
#include <fmt/format.h>

#include "cli/contradictions.h"
#include "cli/help.h"
#include "slicer/thin_finder.h"
#include "slicer/version.h"

namespace lamina::cli {
namespace {

constexpr int kUsageStatus = 2;
constexpr int kFaultStatus = 1;

// A number and nothing else; finite.
std::optional<double> parse_number(std::string_view text) {
  const double_conversion::StringToDoubleConverter converter(
      double_conversion::StringToDoubleConverter::NO_FLAGS, NAN, NAN, nullptr,
      nullptr);
  int used = 0;
  const double value = converter.StringToDouble(
      text.data(), static_cast<int>(text.size()), &used);
  if (text.empty() || used != static_cast<int>(text.size()) ||
      !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

double require_number(const std::string& option, std::string_view text) {
  const std::optional<double> value = parse_number(text);
  if (!value) {
    throw CLI::ValidationError(
        option, fmt::format("a number was expected, not '{}'", text));
  }
  return *value;
}

double require_positive(const std::string& option, std::string_view text) {
  const double value = require_number(option, text);
  if (!(value > 0)) {
    throw CLI::ValidationError(
        option, fmt::format("must be more than 0 mm, not {}", text));
  }
  return value;
}

std::vector<double> parse_heights(const std::string& option,
                                  std::string_view text) {
  std::vector<double> heights;
  while (true) {
    const std::size_t comma = text.find(',');
    heights.push_back(require_number(option, text.substr(0, comma)));
    const std::size_t count = heights.size();
    if (count > 1 && !(heights[count - 1] > heights[count - 2])) {
      throw CLI::ValidationError(option, "heights must rise");
    }
    if (comma == std::string_view::npos) return heights;
    text.remove_prefix(comma + 1);
  }
}

double require_thin_width(const std::string& option, std::string_view text) {
  const double value = require_number(option, text);
  if (!(value >= slicer::kLeastThinWidth &&
        value <= slicer::kGreatestThinWidth)) {
    throw CLI::ValidationError(
        option,
        fmt::format("must be {} to {} mm, not {}", slicer::kLeastThinWidth,
                    slicer::kGreatestThinWidth, text));
  }
  return value;
}

// Finer facets than these are finer than samples that count as one.
constexpr double kLeastChordalError = 1e-6;  // mm

// Beyond these a design is not shrunk or enlarged but mistyped.
constexpr double kLeastScale = 0.001;
constexpr double kGreatestScale = 1000;

// No beam is wider, and no resin bleeds farther [mm].
constexpr double kGreatestCompensation = 100;

double require_within(const std::string& option, std::string_view text,
                      double least, double greatest, std::string_view unit) {
  const double value = require_number(option, text);
  if (!(value >= least && value <= greatest)) {
    throw CLI::ValidationError(
        option, fmt::format("must be from {} to {}{}, not {}", least, greatest,
                            unit, text));
  }
  return value;
}

double parse_scale(const std::string& text) {
  if (text.ends_with('%')) {
    throw CLI::ValidationError(
        "--scale", fmt::format("a factor was expected, such as 1.02 for a "
                               "print 2% larger, not '{}'",
                               text));
  }
  return require_within("--scale", text, kLeastScale, kGreatestScale, "");
}

// The right-handed turn that makes `axis` the building direction.
Affine turn_to_axis(std::string_view axis) {
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  const Vec3 no_shift(0);
  // Columns: where x, y and z of the design go.
  if (axis == "x") return Affine(z, x, y, no_shift);
  if (axis == "y") return Affine(y, z, x, no_shift);
  if (axis == "-x") return Affine(-z, y, x, no_shift);
  if (axis == "-y") return Affine(x, -z, y, no_shift);
  if (axis == "-z") return Affine(x, -y, -z, no_shift);
  return Affine(1.0);
}

// An option whose text `use` reads; `use` throws CLI::ValidationError. `value`
// is what messages call its value.
CLI::Option* add_text(CLI::App& app, const std::string& name,
                      const std::string& value,
                      std::function<void(const std::string&)> use) {
  return app.add_option_function<std::string>(name, std::move(use))
      ->type_name(value);
}

// An option with one of a few words.
void add_choice(CLI::App& app, const std::string& name,
                const std::vector<std::string>& words,
                std::function<void(const std::string&)> use) {
  add_text(app, name, "word", std::move(use))->check(CLI::IsMember(words));
}

// Of walls and gaps to be told of.
void add_thin_width(CLI::App& app, double& width) {
  add_text(app, "--min-feature", "length", [&width](const std::string& text) {
    width = require_thin_width("--min-feature", text);
  });
}

slicer::SamplerKind sampler_kind(std::string_view word) {
  if (word == "gl") return slicer::SamplerKind::kGl;
  if (word == "gl-peeling") return slicer::SamplerKind::kGlPeeling;
  return slicer::SamplerKind::kScanline;
}

void add_slicing_options(CLI::App& app, DesignOptions& options) {
  slicer::Settings& settings = options.settings;
  add_text(app, "--layer", "length", [&](const std::string& text) {
    settings.layer_thickness = require_positive("--layer", text);
  });
  add_text(app, "--heights", "list", [&](const std::string& text) {
    settings.heights = parse_heights("--heights", text);
  });
  add_text(app, "--chordal-error", "length", [&](const std::string& text) {
    options.chordal_error = require_number("--chordal-error", text);
    if (!(options.chordal_error >= kLeastChordalError)) {
      throw CLI::ValidationError("--chordal-error",
                                 "must be at least 0.000001 mm");
    }
  });
  // Two names of one thing: what simplification is for, and what it promises.
  add_text(
      app, "--tolerance,--simplify", "length", [&](const std::string& text) {
        settings.tolerance = require_number("--tolerance", text);
        if (settings.tolerance < 0) {
          throw CLI::ValidationError("--tolerance", "must not be negative");
        }
      });
  add_text(app, "--compensate", "length", [&](const std::string& text) {
    settings.compensation =
        require_within("--compensate", text, -kGreatestCompensation,
                       kGreatestCompensation, " mm");
  });
  add_text(app, "--scale", "factor",
           [&](const std::string& text) { options.scale = parse_scale(text); });
  add_text(app, "--ray", "length", [&](const std::string& text) {
    settings.ray_pitch = text == "auto" ? 0 : require_positive("--ray", text);
  });
  add_choice(app, "--axis", {"z", "x", "y", "-x", "-y", "-z"},
             [&](const std::string& axis) {
               options.world_from_design = turn_to_axis(axis);
             });
  add_choice(
      app, "--contour", {"faithful", "paper"}, [&](const std::string& mode) {
        settings.contour = mode == "paper" ? slicer::ContourMode::kPaper
                                           : slicer::ContourMode::kFaithful;
      });
  add_choice(app, "--boxes", {"local", "global"}, [&](const std::string& mode) {
    settings.boxes =
        mode == "global" ? slicer::BoxMode::kGlobal : slicer::BoxMode::kLocal;
  });
  add_choice(
      app, "--sampler", {"scanline", "gl", "gl-peeling"},
      [&](const std::string& kind) { settings.sampler = sampler_kind(kind); });
  app.add_option("--threads", settings.threads)
      ->check(CLI::Range(1U, 1024U))
      ->type_name("number");
}

// An option that takes what openscad takes for true and false.
void add_switch(CLI::App& app, const std::string& name, bool& target) {
  const std::vector<std::string> words = {"true", "false", "on",
                                          "off",  "1",     "0"};
  add_text(app, name, "word", [&target](const std::string& word) {
    target = word == "true" || word == "on" || word == "1";
  })->transform(CLI::IsMember(words, CLI::ignore_case));
}

void add_design_options(CLI::App& app, DesignOptions& options,
                        std::vector<std::string>& definitions) {
  app.add_option("-D", definitions)
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* set = app.add_option("-P", options.parameter_set);
  CLI::Option* file = app.add_option("-p", options.parameter_file);
  set->type_name("set")->needs(file);
  file->type_name("file")->needs(set);
  add_switch(app, "--check-parameters", options.checks_parameters);
  add_switch(app, "--check-parameter-ranges", options.checks_parameter_ranges);
  app.add_flag("--render", options.render);
  app.add_flag("--preview", options.preview);
  app.add_option("--seed", options.seed)->type_name("number");
  app.add_flag("--hardwarnings", options.has_hard_warnings);
  app.add_flag("-q,--quiet", options.is_quiet);
}

// All that the parsed words are bound to.
struct Parsed {
  DesignOptions design;
  std::string export_format;
  std::vector<std::string> definitions;
  InspectOptions inspect;
  ViewOptions view;
  std::vector<std::string> view_definitions;
};

void add_options(CLI::App& app, Parsed& parsed) {
  app.set_help_flag("-h,--help");
  app.set_version_flag("-v,--version",
                       fmt::format("lamina {}", slicer::version()));
  app.add_option("design", parsed.design.design);
  app.add_option("-o", parsed.design.output)->type_name("file");
  app.add_option("--export-format", parsed.export_format)->type_name("format");
  add_choice(app, "--cli", {"binary", "ascii"}, [&](const std::string& word) {
    parsed.design.cli_encoding = word == "ascii" ? slicer::CliEncoding::kAscii
                                                 : slicer::CliEncoding::kBinary;
  });
  app.add_option("--printer", parsed.design.printer)->type_name("printer");
  add_choice(app, "--mirror", {"x", "y", "xy"}, [&](const std::string& axes) {
    parsed.design.mirrors_x = axes != "y";
    parsed.design.mirrors_y = axes != "x";
  });
  app.add_option("--report", parsed.design.report)->type_name("file");
  app.add_option("-d", parsed.design.dependencies)->type_name("file");
  add_design_options(app, parsed.design, parsed.definitions);
  add_slicing_options(app, parsed.design);
  add_thin_width(app, parsed.design.settings.min_feature);
}

CLI::App* add_inspect(CLI::App& app, InspectOptions& options) {
  CLI::App* inspect = app.add_subcommand("inspect");
  inspect->add_option("file", options.file)->required();
  inspect->add_flag("--all", options.lists_all_layers);
  add_thin_width(*inspect, options.min_feature);
  return inspect;
}

CLI::App* add_view(CLI::App& app, ViewOptions& options,
                   std::vector<std::string>& definitions) {
  CLI::App* view = app.add_subcommand("view");
  view->add_option("file", options.design.design)->required();
  view->add_option("-o", options.design.output)->type_name("file")->required();
  add_choice(
      *view, "--style", {"sheet", "stack"}, [&](const std::string& style) {
        options.picture.style = style == "stack" ? slicer::PictureStyle::kStack
                                                 : slicer::PictureStyle::kSheet;
      });
  view->add_option("--layers", options.picture.layer_count)
      ->check(CLI::Range(1U, 400U))
      ->type_name("number");
  view->add_option("--width", options.picture.width)
      ->check(CLI::Range(200U, 8000U))
      ->type_name("number");
  add_design_options(*view, options.design, definitions);
  add_slicing_options(*view, options.design);
  return view;
}

std::string join_definitions(const std::vector<std::string>& definitions) {
  std::string text;
  for (const std::string& definition : definitions) text += definition + ";\n";
  return text;
}

Exit usage_error(std::string_view message) {
  return {kUsageStatus, fmt::format("lamina: {}\nRun 'lamina --help' for "
                                    "the options.\n",
                                    message)};
}

std::string without_extension(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t dot = path.rfind('.');
  const bool has_extension = dot != std::string::npos && dot > 0 &&
                             (slash == std::string::npos || dot > slash + 1);
  return has_extension ? path.substr(0, dot) : path;
}

// By its name: a file that lamina writes, and no design.
bool holds_layers(const std::string& path) {
  const slicer::FormatChoice choice = slicer::choose_output_format(path);
  return choice.format && slicer::is_of_layers(*choice.format);
}

Command finish_design(Parsed& parsed) {
  DesignOptions& options = parsed.design;
  if (options.design.empty()) return usage_error("no design was given");
  if (holds_layers(options.design)) {
    return usage_error(
        options.design.ends_with(".slc")
            ? fmt::format("'{0}' holds layers already; try 'lamina inspect "
                          "{0}' or 'lamina view {0}'",
                          options.design)
            : fmt::format("'{}' holds layers already", options.design));
  }
  options.definitions = join_definitions(parsed.definitions);
  if (options.output.empty()) {
    const std::string& format = parsed.export_format;
    options.output = without_extension(options.design) + "." +
                     (format.empty() ? "slc" : format);
  }
  if (options.output == "-" && parsed.export_format.empty()) {
    return usage_error("-o - needs --export-format");
  }
  const slicer::FormatChoice choice = slicer::choose_output_format(
      parsed.export_format.empty() ? options.output : parsed.export_format);
  if (!choice.format) {
    if (!choice.is_known) return usage_error(choice.complaint);
    return Exit{kFaultStatus, fmt::format("lamina: {}\n", choice.complaint)};
  }
  options.format = *choice.format;
  if (const char* contradiction = find_contradiction(options.settings)) {
    return usage_error(contradiction);
  }
  if (const char* misfit = find_misfit(options)) return usage_error(misfit);
  return options;
}

Command finish_view(Parsed& parsed) {
  ViewOptions& options = parsed.view;
  options.design.definitions = join_definitions(parsed.view_definitions);
  if (!options.design.output.ends_with(".png")) {
    return usage_error(fmt::format("view draws .png pictures; '{}' is none",
                                   options.design.output));
  }
  const std::string& file = options.design.design;
  if (holds_layers(file) && !file.ends_with(".slc")) {
    return usage_error(fmt::format(
        "view reads layers from .slc only, and designs; not '{}'", file));
  }
  if (const char* contradiction = find_contradiction(options.design.settings)) {
    return usage_error(contradiction);
  }
  return options;
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  Parsed parsed;
  CLI::App app("", "lamina");
  add_options(app, parsed);
  const CLI::App* inspect = add_inspect(app, parsed.inspect);
  const CLI::App* view = add_view(app, parsed.view, parsed.view_definitions);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Exit{0, std::string(inspect->parsed() ? kInspectHelp
                               : view->parsed()  ? kViewHelp
                                                 : kHelp)};
  } catch (const CLI::CallForVersion& version) {
    return Exit{0, fmt::format("{}\n", version.what())};
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what());
  }
  if (inspect->parsed()) return parsed.inspect;
  if (view->parsed()) return finish_view(parsed);
  return finish_design(parsed);
}

}  // namespace lamina::cli
