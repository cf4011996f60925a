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

#include "slicer/version.h"

namespace lamina::cli {
namespace {

constexpr int kUsageStatus = 2;
constexpr int kFaultStatus = 1;

constexpr std::string_view kDescription =
    "lamina compiles OpenSCAD designs straight to the layers of a 3D printer.";
constexpr std::string_view kFooter =
    R"(Output, by the extension of FILE:
  .slc           layers for wax and resin printers (the default)
  .layers.json   layers with every digit, for programs
  .csg .echo .ast   what the design evaluates to, says, and is

Examples:
  lamina ring.scad                          makes ring.slc, layers of 0.05 mm
  lamina ring.scad -o ring.slc --layer 0.025 -D size=54
  lamina inspect ring.slc                   checks it and lists its layers
  lamina view ring.slc -o ring.png          draws it

Exit status: 0 done, 1 the design or a file is at fault, 2 usage,
130 interrupted.)";

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

// An option whose text `use` reads; `use` throws CLI::ValidationError.
CLI::Option* add_text(CLI::App& app, const std::string& name,
                      const std::string& help,
                      std::function<void(const std::string&)> use) {
  return app.add_option_function<std::string>(name, std::move(use), help);
}

void add_slicing_options(CLI::App& app, DesignOptions& options) {
  slicer::Settings& settings = options.settings;
  const char* const group = "Slicing";
  add_text(app, "--layer", "Thickness of a layer",
           [&](const std::string& text) {
             settings.layer_thickness = require_positive("--layer", text);
           })
      ->type_name("MM")
      ->default_str("0.05")
      ->group(group);
  add_text(app, "--heights",
           "Sections at exactly these heights instead, ascending",
           [&](const std::string& text) {
             settings.heights = parse_heights("--heights", text);
           })
      ->type_name("Z1,Z2,…")
      ->group(group);
  add_text(app, "--tolerance",
           "Leave out vertices that move the contour by less; 0 keeps all",
           [&](const std::string& text) {
             settings.tolerance = require_number("--tolerance", text);
             if (settings.tolerance < 0) {
               throw CLI::ValidationError("--tolerance",
                                          "must not be negative");
             }
           })
      ->type_name("MM")
      ->default_str("0.001")
      ->group(group);
  app.add_option_function<std::string>(
         "--axis",
         [&](const std::string& axis) {
           options.world_from_design = turn_to_axis(axis);
         },
         "Direction of building")
      ->check(CLI::IsMember({"z", "x", "y", "-x", "-y", "-z"}))
      ->type_name("z|x|y|-x|-y|-z")
      ->default_str("z")
      ->group(group);
  add_text(app, "--ray", "Distance of rays: speed only, unless --contour paper",
           [&](const std::string& text) {
             settings.ray_pitch =
                 text == "auto" ? 0 : require_positive("--ray", text);
           })
      ->type_name("auto|MM")
      ->default_str("auto")
      ->group(group);
  app.add_option_function<std::string>(
         "--contour",
         [&](const std::string& mode) {
           settings.contour = mode == "paper" ? slicer::ContourMode::kPaper
                                              : slicer::ContourMode::kFaithful;
         },
         "Exact contours, or those of Zeng et al. 2011")
      ->check(CLI::IsMember({"faithful", "paper"}))
      ->type_name("faithful|paper")
      ->default_str("faithful")
      ->group(group);
  app.add_option_function<std::string>(
         "--boxes",
         [&](const std::string& mode) {
           settings.boxes = mode == "global" ? slicer::BoxMode::kGlobal
                                             : slicer::BoxMode::kLocal;
         },
         "Of --contour paper: sample each leaf in its own box or in the whole")
      ->check(CLI::IsMember({"local", "global"}))
      ->type_name("local|global")
      ->default_str("local")
      ->group(group);
  app.add_option_function<std::string>(
         "--sampler",
         [&](const std::string& kind) {
           settings.sampler = kind == "gl" ? slicer::SamplerKind::kGl
                                           : slicer::SamplerKind::kScanline;
         },
         "Of --contour paper: how rays are sampled")
      ->check(CLI::IsMember({"scanline", "gl"}))
      ->type_name("scanline|gl")
      ->default_str("scanline")
      ->group(group);
  app.add_option("--threads", settings.threads,
                 "Threads; as many as the machine has unless given")
      ->check(CLI::Range(1U, 1024U))
      ->type_name("N")
      ->group(group);
}

void add_design_options(CLI::App& app, DesignOptions& options,
                        std::vector<std::string>& definitions) {
  app.add_option("-D", definitions,
                 "Set a variable of the design; may be repeated")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Design");
  app.add_flag("--hardwarnings", options.has_hard_warnings,
               "Stop at the first warning")
      ->group("Design");
  app.add_flag("-q,--quiet", options.is_quiet, "Say nothing but errors")
      ->group("Messages");
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

CLI::App* add_inspect(CLI::App& app, InspectOptions& options) {
  CLI::App* inspect =
      app.add_subcommand("inspect", "Check a .slc file and list its layers");
  inspect->add_option("file", options.file, "An .slc file")->required();
  inspect->add_flag("--all", options.lists_all_layers,
                    "List every layer of a long file");
  return inspect;
}

CLI::App* add_view(CLI::App& app, ViewOptions& options,
                   std::vector<std::string>& definitions) {
  CLI::App* view =
      app.add_subcommand("view", "Draw the layers of a .slc file or a design");
  view->add_option("file", options.design.design, "A .slc, .scad or .csg file")
      ->required();
  view->add_option("-o", options.design.output, "The picture, a .png file")
      ->type_name("FILE")
      ->required();
  view->add_option_function<std::string>(
          "--style",
          [&](const std::string& style) {
            options.picture.style = style == "stack"
                                        ? slicer::PictureStyle::kStack
                                        : slicer::PictureStyle::kSheet;
          },
          "A sheet of single layers, or all of them stacked as a solid")
      ->check(CLI::IsMember({"sheet", "stack"}))
      ->type_name("sheet|stack")
      ->default_str("sheet");
  view->add_option("--layers", options.picture.layer_count,
                   "Layers on the sheet")
      ->check(CLI::Range(1U, 400U))
      ->type_name("N")
      ->default_str(std::to_string(options.picture.layer_count));
  view->add_option("--width", options.picture.width, "Width of the picture")
      ->check(CLI::Range(200U, 8000U))
      ->type_name("PIXELS")
      ->default_str(std::to_string(options.picture.width));
  add_design_options(*view, options.design, definitions);
  add_slicing_options(*view, options.design);
  return view;
}

void add_options(CLI::App& app, Parsed& parsed) {
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("-v,--version",
                       fmt::format("lamina {}", slicer::version()));
  app.footer(std::string(kFooter));
  app.get_formatter()->column_width(34);
  app.add_option("design", parsed.design.design, "A .scad or .csg file")
      ->type_name("FILE");
  app.add_option("-o", parsed.design.output,
                 "Output, by its extension; '-' is standard output; without "
                 "it, ring.slc beside ring.scad")
      ->type_name("FILE")
      ->group("Output");
  app.add_option("--export-format", parsed.export_format,
                 "Format of the output, whatever its name")
      ->type_name("FORMAT")
      ->group("Output");
  app.add_option("--report", parsed.design.report,
                 "Write times, counts and memory as JSON")
      ->type_name("FILE")
      ->group("Messages");
  add_design_options(app, parsed.design, parsed.definitions);
  add_slicing_options(app, parsed.design);
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

Command finish_design(Parsed& parsed) {
  DesignOptions& options = parsed.design;
  if (options.design.empty()) return usage_error("no design was given");
  options.definitions = join_definitions(parsed.definitions);
  if (options.settings.sampler == slicer::SamplerKind::kGl) {
    return Exit{kFaultStatus, "lamina: --sampler gl is not supported yet\n"};
  }
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
  return options;
}

Command finish_view(Parsed& parsed) {
  ViewOptions& options = parsed.view;
  options.design.definitions = join_definitions(parsed.view_definitions);
  if (!options.design.output.ends_with(".png")) {
    return usage_error(fmt::format("view draws .png pictures; '{}' is none",
                                   options.design.output));
  }
  return options;
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  Parsed parsed;
  CLI::App app{std::string(kDescription), "lamina"};
  add_options(app, parsed);
  const CLI::App* inspect = add_inspect(app, parsed.inspect);
  const CLI::App* view = add_view(app, parsed.view, parsed.view_definitions);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const CLI::App* asked = inspect->parsed() ? inspect
                            : view->parsed()  ? view
                                              : &app;
    return Exit{0, asked->help()};
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
