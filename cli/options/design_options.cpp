#include "cli/options/design_options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/ranges.h>

#include "base/text.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "csg/support_tip.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/printer.h"

namespace lamina::cli {
namespace {

// The words of a list, as options take them.
template <typename Words>
std::vector<std::string> texts(const Words& words) {
  return {words.begin(), words.end()};
}

// Of drains [mm].
// Of the root of sprues, and their length [mm].
constexpr double kLeastSprue = 0.5;
constexpr double kGreatestSprue = 50;
constexpr double kLeastDrain = 0.3;
constexpr double kGreatestDrain = 20;

// No list of directions is as long.
constexpr double kLastDirection = 10000;

// As slicer::FindingKind.
constexpr std::array<std::string_view, slicer::kFindingKinds> kFindingWords = {
    "islands", "loose-parts", "overhangs", "suction-cups", "resin-traps"};

// Words between commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream list(text);
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

// "12", "lib.scad:12".
std::vector<std::string> lines_of(const std::string& option,
                                  const std::string& text) {
  std::vector<std::string> lines = words_of(text);
  for (const std::string& line : lines) {
    const std::size_t colon = line.rfind(':');
    const std::string number =
        colon == std::string::npos ? line : line.substr(colon + 1);
    require(colon != 0 && !number.empty() &&
                std::ranges::all_of(
                    number, [](char c) { return c >= '0' && c <= '9'; }),
            option, "expected lines such as 12 or lib.scad:12, not '{}'", line);
  }
  return lines;
}

// "heavy", "0.35", "light,raft", "raft"; "true" where nothing was given.
slicer::SupportSizes sizes_of(const std::string& text) {
  slicer::SupportSizes sizes = {.tip = 0};
  for (const std::string& word : words_of(text)) {
    if (word == "true") continue;
    if (word == "raft") {
      sizes.has_raft = true;
      continue;
    }
    require(sizes.tip == 0, "--supports", "there are two sizes in '{}'", text);
    std::optional<double> tip = csg::support_tip_named(word);
    if (!tip) tip = parse_number(word);
    require(tip && *tip >= csg::kLeastSupportTip &&
                *tip <= csg::kGreatestSupportTip,
            "--supports",
            "expected light, medium, heavy or {:g} to {:g} (mm), and ,raft for "
            "a raft; got '{}'",
            csg::kLeastSupportTip, csg::kGreatestSupportTip, word);
    sizes.tip = *tip;
  }
  return sizes;
}

// text  "1.02", "1.02,1.02,1.015"
Vec3 scale_in(const std::string& text) {
  require(!text.ends_with('%'), "--scale",
          "a factor was expected, such as 1.02 for a print 2% larger, not '{}'",
          text);
  const auto words = words_of(text);
  require(words.size() == 1 || words.size() == 3, "--scale",
          "one factor was expected, or three for x, y and z, not '{}'", text);
  Vec3 scale(0);
  for (int i = 0; i < 3; ++i) {
    scale[i] = require_within("--scale", words[words.size() == 1 ? 0 : i]);
  }
  return scale;
}

// text  "0,1,1", "best", "2"
void take_direction(const std::string& text,
                    compiler::GeometryRequest& geometry) {
  geometry.up.reset();
  geometry.searched_direction = text == "best" ? 1 : 0;
  if (text == "best") return;
  const auto number = parse_number(text);
  if (number && *number >= 1 && *number <= kLastDirection &&
      *number == std::floor(*number)) {
    geometry.searched_direction = static_cast<unsigned>(*number);
    return;
  }
  std::vector<double> numbers;
  const std::vector<std::string> words = words_of(text);
  for (const std::string& word : words) {
    const auto value = parse_number(word);
    if (value) numbers.push_back(*value);
  }
  require(
      words.size() == 3 && numbers.size() == 3 &&
          std::hypot(numbers[0], numbers[1], numbers[2]) > 0,
      "--orient",
      "expected the direction that points up, X,Y,Z, or best, or a number from "
      "1 of the list of 'lamina orient', not '{}'",
      text);
  geometry.up = Vec3(numbers[0], numbers[1], numbers[2]);
}

// text  "0.1", "0.1x4"
slicer::Foot foot_of(const std::string& text) {
  const std::size_t by = std::min(text.find('x'), text.size());
  slicer::Foot foot;
  foot.inset = require_within("--compensate foot", text.substr(0, by));
  if (by == text.size()) return foot;
  const auto layers = whole_number(text.substr(by + 1));
  require(layers && *layers >= 1 && *layers <= slicer::kMostFootLayers,
          "--compensate foot",
          "expected MM or MMxLAYERS, over 1 to {} layers, not '{}'",
          slicer::kMostFootLayers, text);
  foot.layers = static_cast<std::uint32_t>(*layers);
  return foot;
}

// text  "0.03", "0.03,foot=0.1x4,bleed=0.05"; "0": nothing at all, whatever
//       the material's profile says
compiler::CompensationRequest compensation_of(const std::string& text) {
  constexpr std::string_view kFoot = "foot=";
  constexpr std::string_view kBleed = "bleed=";
  compiler::CompensationRequest compensation;
  std::vector<std::string> words = words_of(text);
  if (words.empty()) words.emplace_back();
  const auto once = [&](bool is_first) {
    require(is_first, "--compensate", "'{}' says something twice", text);
  };
  for (const std::string& word : words) {
    if (word.starts_with(kFoot)) {
      once(!compensation.foot);
      compensation.foot = foot_of(word.substr(kFoot.size()));
    } else if (word.starts_with(kBleed)) {
      once(!compensation.bleed);
      compensation.bleed =
          require_within("--compensate bleed", word.substr(kBleed.size()));
    } else {
      require(word.find('=') == std::string::npos, "--compensate",
              "expected MM, foot=MM, foot=MMxLAYERS or bleed=MM, not '{}'",
              word);
      once(!compensation.contour);
      compensation.contour = require_within("--compensate", word);
    }
  }
  if (words.size() == 1 && compensation.contour == 0.0) {
    compensation.drop_bed();
  }
  return compensation;
}

slicer::HollowSizes& hollow_of(compiler::Request& request) {
  if (!request.hollow) request.hollow.emplace();
  return *request.hollow;
}

// text  "none", "1.5", "0,0,3.5,1.5"
void add_drain(const std::string& text, slicer::HollowSizes& sizes) {
  if (text == "none") {
    sizes.has_drains = false;
    return;
  }
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    const auto value = parse_number(word);
    require(value.has_value(), "--drain",
            "expected a diameter, X,Y,Z,DIAMETER or none, not '{}'", text);
    numbers.push_back(*value);
  }
  require((numbers.size() == 1 || numbers.size() == 4) &&
              numbers.back() >= kLeastDrain && numbers.back() <= kGreatestDrain,
          "--drain",
          "expected a diameter of {:g} to {:g} mm, X,Y,Z,DIAMETER or none, "
          "not '{}'",
          kLeastDrain, kGreatestDrain, text);
  if (numbers.size() == 1) {
    sizes.drain_diameter = numbers[0];
  } else {
    sizes.drains.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  }
}

// "4", "4,8", "disc"; "true" where nothing was given.
slicer::SprueSizes sprues_of(const std::string& text) {
  slicer::SprueSizes sizes;
  std::vector<double> lengths;
  for (const std::string& word : words_of(text)) {
    if (word == "true") continue;
    if (word == "disc") {
      sizes.has_disc = true;
      continue;
    }
    const auto length = parse_number(word);
    require(length && *length >= kLeastSprue && *length <= kGreatestSprue &&
                lengths.size() < 2,
            "--sprue",
            "expected the diameter of the root and the length, {:g} to {:g} "
            "mm, and ,disc for a disc, such as 4,8,disc; got '{}'",
            kLeastSprue, kGreatestSprue, text);
    lengths.push_back(*length);
  }
  if (!lengths.empty()) sizes.root = lengths[0];
  if (lengths.size() == 2) sizes.length = lengths[1];
  return sizes;
}

// words  "islands,loose-parts", "all"
void add_findings(const std::string& words, slicer::PrintRules& rules) {
  for (const std::string& word : words_of(words)) {
    if (word == "all") {
      rules.fail_on = slicer::kAllFindings;
      continue;
    }
    const auto* const found = std::ranges::find(kFindingWords, word);
    require(found != kFindingWords.end(), "--fail-on",
            "{} or all was expected, not '{}'", fmt::join(kFindingWords, ", "),
            word);
    rules.fail_on.insert(
        static_cast<slicer::FindingKind>(found - kFindingWords.begin()));
  }
}

// words  "60/l, 62.5 EUR/g"
void add_prices(const std::string& words, std::vector<slicer::Price>& prices) {
  std::istringstream list(words);
  for (std::string word; std::getline(list, word, ',');) {
    const auto price = slicer::parse_price(trim(word));
    require(price.has_value(), "--price",
            "a sum for one of {} was expected, such as 62.5/g or '60 EUR/l', "
            "not '{}'",
            fmt::join(slicer::kPriceUnits, ", "), word);
    prices.push_back(*price);
  }
}

}  // namespace

void add_design_options(OptionList& options, compiler::Request& request,
                        bool& is_quiet) {
  options.count("--max-depth", request.design.max_depth);
  options.count("--max-leaves", request.design.max_leaves);
  options.flag("--hardwarnings", request.design.has_hard_warnings);
  options.flag("-q,--quiet", is_quiet);

  options.begin_group(kDesignGroup);
  options.texts("-D", "NAME=VALUE", [&request](const std::string& definition) {
    // A name alone would be a syntax error of a text that nobody wrote.
    const bool is_name = std::ranges::all_of(definition, [](char letter) {
      return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
             letter == '_' || letter == '$';
    });
    require(!is_name, "-D", "NAME=VALUE was expected, such as {}=10, not '{}'",
            definition.empty() ? "size" : definition, definition);
    request.design.definitions += definition + ";\n";
  });
  const Option set = options.text("-P", "set", [&](const std::string& name) {
    request.design.parameter_set = name;
  });
  const Option file = options.name("-p", "file", request.design.parameter_file);
  set.needs(file);
  file.needs(set);
  options.text("--part", "name",
               [&](const std::string& name) { request.design.part = name; });
  options.boolean("--check-parameters", request.design.checks_parameters);
  options.boolean("--check-parameter-ranges",
                  request.design.checks_parameter_ranges);
  options.flag("--render", request.design.render);
  options.flag("--preview", request.design.preview);
  // What openscad's mesh Booleans and unfinished features are, lamina has not.
  options.text("--backend", "name", [](const std::string& /*name*/) {});
  options.texts("--enable", "feature", [](const std::string& /*name*/) {});
  options.integer("--seed", request.design.seed);
  options.choice(
      "--language", texts(compiler::kLanguageWords),
      [&](const std::string& word) { request.design.language = word; });
  options.end_group();
}

void add_facet_options(OptionList& options, compiler::Request& request) {
  options.count("--threads", request.job.threads);
  options.begin_group(kDesignGroup);
  options.number("--chordal-error", "length", request.geometry.chordal_error);
  options.number("--decimate", "length", request.geometry.decimation);
  options.end_group();
}

void add_sprue_option(OptionList& options, compiler::Request& request) {
  options.begin_group(kDesignGroup);
  options.flag("--sprue", [&request](const std::string& sizes) {
    request.sprues = sprues_of(sizes);
  });
  options.end_group();
}

void add_slicing_options(OptionList& options, compiler::Request& request) {
  add_facet_options(options, request);
  add_sprue_option(options, request);
  slicer::Settings& settings = request.job;
  options.begin_group(kDesignGroup);
  options.number("--layer", "length", settings.layer_thickness);
  options.number("--adaptive", "length", settings.cusp);
  options.number("--max-layer", "length", settings.greatest_thickness);
  options.text("--heights", "list", [&](const std::string& text) {
    settings.heights = require_numbers("--heights", text);
  });
  options.number("--tolerance", "length", settings.tolerance);
  options.text("--compensate", "lengths", [&request](const std::string& text) {
    request.compensation = compensation_of(text);
  });
  options.text("--scale", "factor", [&](const std::string& text) {
    request.geometry.scale = scale_in(text);
  });
  options.text("--ray", "length", [&](const std::string& text) {
    settings.ray_pitch = text == "auto" ? 0 : require_within("--ray", text);
  });
  options.choice(
      "--axis", texts(compiler::kAxisWords),
      [&](const std::string& axis) { request.geometry.axis = axis; });
  options.text("--orient", "direction", [&request](const std::string& text) {
    take_direction(text, request.geometry);
  });
  options.number("--turn", "degrees", request.geometry.turn);
  options.flag("--supports", [&request](const std::string& size) {
    request.supports = sizes_of(size);
  });
  options.text("--support-on", "lines", [&request](const std::string& text) {
    request.support_lines.only = lines_of("--support-on", text);
  });
  options.text("--no-support-on", "lines", [&request](const std::string& text) {
    request.support_lines.without = lines_of("--no-support-on", text);
  });
  options.text("--hollow", "length", [&request](const std::string& text) {
    hollow_of(request).wall = require_within("--hollow", text);
  });
  options.text(
      "--hollow-closing", "length", [&request](const std::string& text) {
        hollow_of(request).closing = require_within("--hollow-closing", text);
      });
  options.texts("--drain", "drain", [&request](const std::string& text) {
    add_drain(text, hollow_of(request));
  });
  options.flag("--drain-plug",
               [&request] { hollow_of(request).has_plugs = true; });
  options.flag("--place-on-bed", request.geometry.is_placed_on_bed);
  options.choice(
      "--contour", {"faithful", "paper"}, [&](const std::string& mode) {
        settings.contour = mode == "paper" ? slicer::ContourMode::kPaper
                                           : slicer::ContourMode::kFaithful;
      });
  options.choice("--boxes", {"local", "global"}, [&](const std::string& mode) {
    settings.paper.boxes =
        mode == "global" ? ldni::BoxMode::kGlobal : ldni::BoxMode::kLocal;
  });
  // gl-peeling is another name of gl, from when gl was a method of its own.
  options.choice("--sampler", {"scanline", "gl", "gl-peeling"},
                 [&](const std::string& kind) {
                   settings.paper.sampler = kind == "scanline"
                                                ? ldni::SamplerKind::kScanline
                                                : ldni::SamplerKind::kGl;
                 });
  options.end_group();
}

void refuse_layers(const std::string& file) {
  refuse_if(slicer::is_named_as_layers(file),
            "'{0}' holds layers already; try 'lamina inspect {0}' or 'lamina "
            "view {0}'",
            file);
}

void note_design_option(OptionList& options, compiler::Request& request) {
  options.on_read([&options, &request] {
    for (const GivenOption& option : options.given()) {
      if (option.group != kDesignGroup) continue;
      request.design.given_option = option.name;
      return;
    }
  });
}

void add_machine_options(OptionList& options, compiler::Request& request) {
  options.name("--printer", "printer", request.output.printer);
  options.name("--material", "material", request.output.material);
  options.name("--metal", "metal", request.output.metal);
  options.texts("--price", "prices", [&request](const std::string& text) {
    add_prices(text, request.output.prices);
  });
}

void add_print_options(OptionList& options, compiler::Request& request) {
  slicer::PrintRules& rules = request.job.print;
  options.number("--min-feature", "length", request.job.min_feature);
  options.number("--self-supporting", "length", rules.self_supporting);
  options.texts(
      "--fail-on", fmt::format("{{{},all}}", fmt::join(kFindingWords, ",")),
      [&rules](const std::string& words) { add_findings(words, rules); });
}

void add_strict_options(OptionList& options, compiler::Request& request) {
  const Option strict =
      options.flag("--strict", [&request] { request.output.is_strict = true; });
  options.flag("--no-strict", [&request] { request.output.is_strict = false; })
      .excludes(strict);
}

void add_output_options(OptionList& options, compiler::Request& request,
                        OutputOptions& output) {
  options.name("--export-format", "format", output.export_format);
  options.choice(
      "--cli", {"binary", "ascii"}, [&request](const std::string& word) {
        request.output.cli_encoding = word == "ascii"
                                          ? slicer::CliEncoding::kAscii
                                          : slicer::CliEncoding::kBinary;
      });
  add_strict_options(options, request);
  add_machine_options(options, request);
  options.choice("--mirror", {"x", "y", "xy"},
                 [&request](const std::string& axes) {
                   request.output.mirrors_x = axes != "y";
                   request.output.mirrors_y = axes != "x";
                 });
  options.name("--report", "file", output.report);
  add_print_options(options, request);
  options.layer_range(request.job.written);
}

std::string usual_extension(const compiler::Request& request,
                            const OutputOptions& options) {
  if (!options.export_format.empty()) return options.export_format;
  const std::string& name = request.output.printer;
  if (name.empty() || name.ends_with(".json")) return "slc";
  const slicer::Printer printer = slicer::find_printer(name);
  return slicer::usual_extension(printer.title, printer.reads);
}

std::string with_extension(const compiler::Request& request,
                           const OutputOptions& options) {
  const std::string& path = request.output.path;
  const bool says_format = path == "-" || request.output.printer.empty() ||
                           !options.export_format.empty() ||
                           std::filesystem::path(path).has_extension();
  return says_format
             ? path
             : fmt::format("{}.{}", path, usual_extension(request, options));
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
