#include "compiler/supports.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/machine.h"
#include "compiler/source_lines.h"
#include "csg/boundary/move_scene.h"
#include "csg/support_tip.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/plan/orientation.h"
#include "slicer/slice/leaf_at.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"
#include "slicer/supports/raft_label.h"
#include "slicer/supports/support_text.h"

namespace lamina::compiler {
namespace {

// The design alone, where it stands by itself: the print is moved and enlarged
// with its supports.
Request without_supports(const Request& request) {
  Request part = request;
  part.supports.reset();
  if (part.hollow) {
    const Vec3 scale = part.geometry.scale;
    part.hollow =
        part.hollow->scaled(1 / std::min({scale.x, scale.y, scale.z}));
    part.hollow->has_plugs = false;
  }
  part.geometry.scale = Vec3(1);
  part.geometry.is_placed_on_bed = false;
  part.job.written = {};
  part.job.min_feature = 0;
  part.job.finds_makers = false;
  part.compensation.drop_bed();
  return part;
}

std::vector<double> heights_of(const std::vector<slicer::Layer>& layers) {
  std::vector<double> heights;
  for (const slicer::Layer& layer : layers) heights.push_back(layer.section_z);
  return heights;
}

// "ring.scad:12" for "12", which means the design itself.
std::vector<std::string> with_files(std::vector<std::string> lines,
                                    const std::string& design) {
  for (std::string& line : lines) {
    if (line.find(':') == std::string::npos) line = design + ':' + line;
  }
  return lines;
}

SupportLines lines_of(const Request& request) {
  return {with_files(request.support_lines.only, request.design.path),
          with_files(request.support_lines.without, request.design.path)};
}

// Whether a line, "ring.scad:12", made the leaf or called what made it.
bool is_of_line(const csg::Instance& instance, std::string_view line) {
  const auto fits = [&](const SourceRange& range) {
    if (!range.is_written()) return false;
    return fmt::format("/{}:{}", range.source->path(),
                       range.source->line_column(range.begin).line)
        .ends_with(fmt::format("/{}", line));
  };
  if (fits(instance.range)) return true;
  for (const csg::CallSite* call = instance.caller; call != nullptr;
       call = call->caller) {
    if (fits(call->range)) return true;
  }
  return false;
}

bool is_of_lines(const csg::Instance& instance,
                 const std::vector<std::string>& lines) {
  return std::ranges::any_of(lines, [&](const std::string& line) {
    return is_of_line(instance, line);
  });
}

void warn_of_unheld(const slicer::SupportPlan& plan, Diagnostics& diagnostics) {
  const auto warn = [&](std::string_view what, Vec3 place) {
    diagnostics.own_warning({}, fmt::format("{} {}", what, place_text(place)));
  };
  for (const Vec3 place : plan.unheld) {
    warn("cannot route a support to", place);
  }
  for (const Vec3 place : plan.unwanted) {
    warn("needs a support, but the design or an option forbids it, at", place);
  }
}

// Warns of a `$support` that is not one, and of lines that make nothing.
void warn_of_marks(const csg::Scene& scene, const SupportLines& lines,
                   Diagnostics& diagnostics) {
  for (const csg::Instance& instance : scene.instances) {
    if (!std::isnan(instance.support_tip)) continue;
    diagnostics.own_warning(
        {}, fmt::format("$support is not \"none\", \"light\", \"medium\", "
                        "\"heavy\" or a number from {:g} to {:g}, at {}",
                        csg::kLeastSupportTip, csg::kGreatestSupportTip,
                        line_text(instance)));
    break;
  }
  for (const auto& some : {lines.only, lines.without}) {
    for (const std::string& line : some) {
      const bool is_known = std::ranges::any_of(
          scene.instances, [&](const csg::Instance& instance) {
            return is_of_line(instance, line);
          });
      if (is_known) continue;
      diagnostics.own_warning({},
                              fmt::format("no solid comes from line {}", line));
    }
  }
}

// Names the lines of what the supports hold.
void name_lines(const csg::Scene& scene,
                const std::vector<slicer::Layer>& layers,
                slicer::SupportPlan& plan) {
  const std::vector<double> heights = heights_of(layers);
  const auto grid = ldni::LayerGrid::at_heights(heights);
  std::vector<slicer::SupportContact> contacts;
  for (const slicer::Support& support : plan.supports) {
    const auto layer = std::ranges::lower_bound(heights, support.contact.z);
    contacts.push_back(
        {.place = Vec2(support.contact),
         .section_z = layer == heights.end() ? heights.back() : *layer});
  }
  slicer::find_makers(scene, grid, std::span(contacts));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].instance == slicer::kNoInstance) continue;
    plan.supports[i].holds = line_text(scene.instances[contacts[i].instance]);
  }
}

// The box of the label's outline, in the font that text() has.
Box2 label_box(const std::string& label, text::Typesetter& typesetter,
               Diagnostics& diagnostics) {
  csg::TextParams params;
  params.text = label;
  params.size = slicer::kLabelSize;
  params.direction = "ltr";
  params.language = "en";
  params.halign = "left";
  params.valign = "baseline";
  Box2 box;
  for (const auto& contour :
       typesetter.outline(params, {.count = 8}, {}, diagnostics)) {
    for (const Vec2 point : contour) box.add(point);
  }
  return box;
}

void add_label(const Request& request, text::Typesetter& typesetter,
               slicer::SupportPlan& plan, Diagnostics& diagnostics) {
  const std::string& label = request.raft_label;
  if (label.empty()) return;
  const Box2 box = label_box(label, typesetter, diagnostics);
  if (box.is_empty() || !slicer::add_label(label, box, plan)) {
    diagnostics.own_warning(
        {}, fmt::format("no label {}: {}", in_quotes(label),
                        box.is_empty() ? "the font has no letters for it"
                                       : "the part needs no supports, so there "
                                         "is no raft"));
  }
}

}  // namespace

slicer::SupportSizes support_sizes(const slicer::SupportSizes& asked,
                                   const Machine& machine) {
  slicer::SupportSizes sizes = asked;
  if (sizes.tip == 0 && machine.material) {
    sizes.tip = machine.material->support_tip;
  }
  if (sizes.tip == 0) sizes.tip = slicer::SupportSizes().tip;
  return sizes;
}

std::vector<slicer::MarkedSolid> marked_solids(
    const csg::Scene& scene, const std::vector<slicer::Layer>& layers,
    const Request& request) {
  const SupportLines lines = lines_of(request);
  const auto tip_of = [&](const csg::Instance& instance) {
    if (is_of_lines(instance, lines.without)) return 0.0;
    if (!lines.only.empty() && !is_of_lines(instance, lines.only)) return 0.0;
    // It comes from a float.
    return std::round(double{instance.support_tip} * 1e4) / 1e4;
  };
  std::set<double> tips;
  for (const csg::Instance& instance : scene.instances) {
    const double tip = tip_of(instance);  // NaN where it means nothing
    if (tip >= 0) tips.insert(tip);
  }
  slicer::Settings settings;
  settings.heights = heights_of(layers);
  std::vector<slicer::MarkedSolid> marked;
  for (const double tip : tips) {
    const auto leaves = slicer::leaves_of(
        scene, [&](const csg::Instance& one) { return tip_of(one) == tip; });
    marked.push_back({tip, slicer::all_layers(*leaves, settings)});
  }
  return marked;
}

std::optional<slicer::SupportPlan> plan_supports(const Request& request,
                                                 std::size_t evaluation_stack,
                                                 TemporaryFiles& files,
                                                 Diagnostics& diagnostics) {
  const Request part = without_supports(request);
  const Machine machine = choose_machine(request.output, files.file_access());
  Compilation compilation(part, files);
  compilation.evaluation_stack = evaluation_stack;
  std::optional<csg::Lowered> lowered;
  std::vector<slicer::Layer> layers;
  try {
    lowered = make_geometry(compilation);
    if (!lowered || lowered->scene() == nullptr) return std::nullopt;
    layers = slicer::all_layers(*lowered->scene(), settings_of(part, machine));
  } catch (const InternalError&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
  const csg::Scene& scene = *lowered->scene();
  if (slicer::supports_of(scene)) {
    throw GeometryError(
        "The design has supports already; add them to the design without");
  }
  warn_of_marks(scene, lines_of(request), diagnostics);
  slicer::SupportPlan plan =
      slicer::plan_supports(layers, support_sizes(*request.supports, machine),
                            marked_solids(scene, layers, request));
  name_lines(scene, layers, plan);
  add_label(request, compilation.readers.typesetter, plan, diagnostics);
  warn_of_unheld(plan, diagnostics);
  return plan;
}

std::string support_lines(const slicer::SupportPlan& plan,
                          const GeometryRequest& geometry) {
  return slicer::support_text(plan, csg::inverse_of(turn_of(geometry)));
}

}  // namespace lamina::compiler
