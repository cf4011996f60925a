#include "compiler/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/ranges.h>

#include "slicer/check/thin/thin_finder.h"

namespace lamina::compiler {
namespace {

constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
constexpr double kUnlimited = std::numeric_limits<double>::max();

// Facets that are nearer to the curve than this are finer than the distance
// below which two samples count as one [mm].
constexpr double kLeastChordalError = 1e-6;

// Beyond these a design is not shrunk or enlarged but mistyped.
constexpr double kLeastScale = 0.001;
constexpr double kGreatestScale = 1000;

constexpr std::string_view kMoreThanZero = "must be more than 0 mm, not {0}";
constexpr std::string_view kAtLeastAMillionth = "must be at least 0.000001 mm";
constexpr std::string_view kFromTo = "must be from {1} to {2}, not {0}";

slicer::Foot foot_of(const Request& request) {
  return request.compensation.foot.value_or(slicer::Foot());
}

constexpr std::array<NumberLimits, 23> kNumbers = {{
    {"--layer", kAboveZero, kUnlimited, kMoreThanZero,
     [](const Request& r) { return r.job.layer_thickness; }},
    {"--adaptive", kAboveZero, kUnlimited, kMoreThanZero,
     [](const Request& r) { return r.job.cusp; }, true},
    {"--max-layer", kAboveZero, kUnlimited, kMoreThanZero,
     [](const Request& r) { return r.job.greatest_thickness; }, true},
    {"--ray", kAboveZero, kUnlimited, kMoreThanZero,
     [](const Request& r) { return r.job.ray_pitch; }, true},
    {"--tolerance", 0, kUnlimited, "must not be negative",
     [](const Request& r) { return r.job.tolerance; }},
    {"--compensate", -slicer::kGreatestCompensation,
     slicer::kGreatestCompensation, "must be from {1} to {2} mm, not {0}",
     [](const Request& r) { return r.compensation.contour.value_or(0); }},
    {"--compensate foot", 0, slicer::kGreatestFoot,
     "must be from {1} to {2} mm, not {0}",
     [](const Request& r) { return foot_of(r).inset; }},
    {"--compensate foot", 1, slicer::kMostFootLayers,
     "must fade over {1} to {2} layers, not {0}",
     [](const Request& r) { return static_cast<double>(foot_of(r).layers); }},
    {"--compensate bleed", 0, slicer::kGreatestBleed,
     "must be from {1} to {2} mm, not {0}",
     [](const Request& r) { return r.compensation.bleed.value_or(0); }},
    {"--min-feature", slicer::kLeastThinWidth, slicer::kGreatestThinWidth,
     "must be {1} to {2} mm, not {0}",
     [](const Request& r) { return r.job.min_feature; }, true},
    {"--self-supporting", kAboveZero, kUnlimited, kMoreThanZero,
     [](const Request& r) { return r.job.print.self_supporting; }, true},
    {"--threads", 1, 1024, kFromTo,
     [](const Request& r) { return static_cast<double>(r.job.threads); }, true},
    {"--scale", kLeastScale, kGreatestScale, kFromTo,
     [](const Request& r) { return r.geometry.scale.x; }},
    {"--scale", kLeastScale, kGreatestScale, kFromTo,
     [](const Request& r) { return r.geometry.scale.y; }},
    {"--scale", kLeastScale, kGreatestScale, kFromTo,
     [](const Request& r) { return r.geometry.scale.z; }},
    {"--turn", -360, 360, "must be from {1} to {2} degrees, not {0}",
     [](const Request& r) { return r.geometry.turn; }},
    {"--chordal-error", kLeastChordalError, kUnlimited, kAtLeastAMillionth,
     [](const Request& r) { return r.geometry.chordal_error; }, true},
    {"--decimate", kLeastChordalError, kUnlimited, kAtLeastAMillionth,
     [](const Request& r) { return r.geometry.decimation; }, true},
    {"--hollow", 0.1, kUnlimited, "must be a wall of 0.1 mm or more, not {0}",
     [](const Request& r) { return r.hollow ? r.hollow->wall : 0; }, true},
    {"--hollow-closing", 0, kUnlimited, "must be 0 mm or more, not {0}",
     [](const Request& r) { return r.hollow ? r.hollow->closing : 0; }, true},
    {"--max-depth", 1, csg::kMostNestedCalls, kFromTo,
     [](const Request& r) { return static_cast<double>(r.design.max_depth); }},
    {"--max-leaves", 1, 1e9, kFromTo,
     [](const Request& r) { return static_cast<double>(r.design.max_leaves); }},
    {"--at", -kUnlimited, kUnlimited, "must be a height in mm, not {0}",
     [](const Request& r) { return r.output.dump_height.value_or(0); }},
}};

void require(const NumberLimits& limits, double value) {
  refuse_if(!limits.hold(value), "{}: {}", limits.option,
            limits.fault_of(fmt::format("{}", value)));
}

template <typename Words>
void require_word(std::string_view option, const Words& words,
                  const std::string& word) {
  refuse_if(std::ranges::find(words, word) == words.end(),
            "{}: '{}' is not one of {}", option, word, fmt::join(words, ", "));
}

void require_heights(const std::vector<double>& heights) {
  refuse_if(std::ranges::adjacent_find(heights, std::greater_equal<>()) !=
                    heights.end() ||
                !std::ranges::all_of(heights,
                                     [](double z) { return std::isfinite(z); }),
            "--heights: heights must rise");
}

void refuse_turn(const Request& request) {
  const GeometryRequest& geometry = request.geometry;
  const bool is_searched = geometry.searched_direction > 0;
  refuse_if((geometry.up || is_searched) && geometry.axis != "z",
            "--orient says what points up, not with --axis");
  refuse_if(is_searched && !request.job.heights.empty(),
            "--orient best needs layers, not --heights");
  refuse_if(geometry.turn != 0 && geometry.axis == kAutomaticAxis,
            "--axis auto turns the part itself, if it must; not with --turn");
  const Vec3 scale = geometry.scale;
  refuse_if((scale.x != scale.y || scale.y != scale.z) &&
                geometry.axis == kAutomaticAxis,
            "--scale X,Y,Z needs an axis, not --axis auto");
  refuse_if(!request.supports && (!request.support_lines.only.empty() ||
                                  !request.support_lines.without.empty()),
            "--support-on and --no-support-on need --supports");
  refuse_if(!request.raft_label.empty() &&
                (!request.supports || !request.supports->has_raft),
            "--label needs a raft: --supports=medium,raft");
  refuse_if(
      request.sprues && request.hollow,
      "--sprue plans the flow into a solid piece, not into a --hollow one");
  refuse_if(request.supports && geometry.axis == kAutomaticAxis,
            "--supports needs an axis, not --axis auto");
  refuse_if(request.supports && !request.job.heights.empty(),
            "--supports needs layers, not --heights");
}

void refuse_hollow(const Request& request) {
  if (!request.hollow) return;
  const slicer::HollowSizes& sizes = *request.hollow;
  refuse_if(sizes.wall == 0,
            "--hollow-closing, --drain and --drain-plug need --hollow");
  refuse_if(!sizes.drains.empty() && request.geometry.axis == kAutomaticAxis,
            "--drain X,Y,Z,D needs an axis, not --axis auto");
  refuse_if(
      !sizes.has_drains && (sizes.drain_diameter > 0 || !sizes.drains.empty()),
      "--drain none goes with no other --drain");
  refuse_if(sizes.has_plugs && !sizes.has_drains,
            "--drain-plug needs drains, not --drain none");
  refuse_if(!request.job.heights.empty(),
            "--hollow needs layers, not --heights");
}

void refuse_part(const DesignRequest& design) {
  refuse_if(!design.part.empty() && (design.text || !has_parts(design.path)),
            "--part names a part of a CAD file or a 3MF; '{}' is neither",
            design.path);
}

void refuse_contradictions(const slicer::Settings& job) {
  const bool is_paper = job.contour == slicer::ContourMode::kPaper;
  refuse_if(job.min_feature > 0 && is_paper,
            "--min-feature needs --contour faithful");
  refuse_if(!job.print.fail_on.empty() && !slicer::makes_whole_print(job),
            "--fail-on needs all layers, not --heights or --layers");
  refuse_if(job.paper.boxes == ldni::BoxMode::kGlobal && !is_paper,
            "--boxes global needs --contour paper");
  const bool is_adaptive = job.cusp > 0;
  const bool has_heights = !job.heights.empty();
  refuse_if(is_adaptive && has_heights,
            "--adaptive and --heights say different things");
  refuse_if(job.greatest_thickness > 0 && !is_adaptive,
            "--max-layer needs --adaptive");
  refuse_if(job.greatest_thickness > 0 &&
                job.greatest_thickness < job.layer_thickness,
            "--max-layer must not be less than --layer");
  const bool is_drawn = job.paper.sampler != ldni::SamplerKind::kScanline;
  refuse_if(is_drawn && !is_paper,
            "--sampler gl and gl-peeling need --contour paper");
  refuse_if(is_drawn && (is_adaptive || has_heights),
            "--sampler gl and gl-peeling need layers of one thickness, not "
            "--heights or --adaptive");
}

// Refuses what the format of the output cannot give.
void refuse_misfits(const Request& request) {
  using enum slicer::OutputFormat;
  const OutputRequest& output = request.output;
  const slicer::Settings& job = request.job;
  const slicer::OutputFormat format = output.format;
  const bool has_layers = output.is_of_layers();
  refuse_if(output.dump && !output.dump_height,
            "--dump needs --at, a height in the layer");
  refuse_if(!output.dump && output.dump_height, "--at needs --dump");
  refuse_if(output.dump && job.contour == slicer::ContourMode::kPaper,
            "--dump needs --contour faithful");
  refuse_if(!has_layers && job.min_feature > 0, "--min-feature needs layers");
  refuse_if(!has_layers && !output.printer.empty(), "--printer needs layers");
  refuse_if(!has_layers && !output.material.empty(), "--material needs layers");
  refuse_if(!has_layers && !output.metal.empty(), "--metal needs layers");
  refuse_if(
      !output.prices.empty() && output.material.empty() && output.metal.empty(),
      "--price needs --material or --metal");
  refuse_if(
      !slicer::is_of_images(format) && (output.mirrors_x || output.mirrors_y),
      "--mirror needs images: .png, .sl1, .zip, .goo or .ctb");
  refuse_if(output.cli_encoding && format != kCli, "--cli needs .cli output");
  const bool has_heights = !job.heights.empty();
  refuse_if(
      slicer::needs_one_thickness(format) && (job.cusp > 0 || has_heights),
      ".sl1, .zip, .goo and .ctb need layers of one thickness, not "
      "--heights or --adaptive");
  refuse_if(format == kThreemf && has_heights,
            ".slices.3mf needs layers, not --heights");
}

}  // namespace

std::string NumberLimits::fault_of(std::string_view given) const {
  return fmt::format(fmt::runtime(words), given, least, greatest);
}

const NumberLimits& limits_of(std::string_view option) {
  const auto* const found =
      std::ranges::find(kNumbers, option, &NumberLimits::option);
  LAMINA_CHECK_EQ(found != kNumbers.end(), true);
  return *found;
}

void validate(const Request& request) {
  for (const NumberLimits& limits : kNumbers) {
    const double value = limits.value_of(request);
    if (!limits.is_optional || value != 0) require(limits, value);
  }
  require_word("--axis", kAxisWords, request.geometry.axis);
  require_word("--language", kLanguageWords, request.design.language);
  require_heights(request.job.heights);
  refuse_contradictions(request.job);
  refuse_turn(request);
  refuse_hollow(request);
  refuse_part(request.design);
  refuse_misfits(request);
}

std::string rename_options(
    std::string_view text,
    const std::function<std::string(std::string name)>& own_name) {
  std::string renamed;
  while (true) {
    const std::size_t begin = text.find("--");
    renamed += text.substr(0, begin);
    if (begin == std::string_view::npos) return renamed;
    text.remove_prefix(begin + 2);
    const std::size_t end = std::min(text.find_first_of(" :,;"), text.size());
    renamed += own_name(std::string(text.substr(0, end)));
    text.remove_prefix(end);
  }
}

}  // namespace lamina::compiler
