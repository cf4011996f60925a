#include "compiler/orient.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/machine.h"
#include "compiler/passes.h"
#include "compiler/supports.h"
#include "csg/boundary/move_scene.h"
#include "slicer/plan/orientation.h"
#include "slicer/slice/slice.h"
#include "slicer/slice/visible_surface.h"
#include "slicer/supports/support_plan.h"

namespace lamina::compiler {
namespace {

// Layers in which directions are compared first [mm], at least.
constexpr double kCoarseLayer = 0.1;

// Share of the directions that are spread over the sphere.
constexpr double kCoarseShare = 0.55;
// Around each of the best of these there are so many finer ones.
constexpr std::size_t kNeighbours = 8;

// As its text has it.
Vec3 in_thousandths(Vec3 up) {
  for (int i = 0; i < 3; ++i) up[i] = std::round(up[i] * 1000) / 1000 + 0.0;
  return up;
}

std::vector<Vec3> spread_directions(std::size_t count) {
  std::vector<Vec3> directions;
  for (const std::string_view axis : slicer::kAxes) {
    const Affine turn = slicer::turn_to_axis(axis);
    directions.push_back({turn[0].z, turn[1].z, turn[2].z});
  }
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z =
        1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double radius = std::sqrt(1 - z * z);
    const double angle = golden * static_cast<double>(i);
    directions.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return directions;
}

// Directions around another one, at an angle [rad].
std::vector<Vec3> neighbours_of(Vec3 up, double angle) {
  const Vec3 aside = csg::perpendicular_to(up);
  const Vec3 other = glm::cross(up, aside);
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < kNeighbours; ++i) {
    const double turn =
        2 * std::numbers::pi * static_cast<double>(i) / kNeighbours;
    directions.push_back(glm::normalize(
        std::cos(angle) * up +
        std::sin(angle) * (std::cos(turn) * aside + std::sin(turn) * other)));
  }
  return directions;
}

// Whether a is as good as b in all that counts, and better in some.
template <std::size_t count>
bool dominates(const std::array<double, count>& a,
               const std::array<double, count>& b) {
  bool is_better = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (a[i] > b[i]) return false;
    is_better = is_better || a[i] < b[i];
  }
  return is_better;
}

// The indices of what is judged, front by front: first what no other dominates,
// then what only these do. Within a front the least sum of relative figures
// comes first.
template <typename Figures>
std::vector<std::size_t> in_order(const std::vector<JudgedDirection>& judged,
                                  const Figures& figures, bool only_first) {
  using Row = decltype(figures(judged.front()));
  std::vector<Row> rows;
  for (const JudgedDirection& one : judged) rows.push_back(figures(one));
  Row least = rows.front();
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      least[i] = std::min(least[i], row[i]);
    }
  }
  const auto cost = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < least.size(); ++k) {
      sum += (rows[i][k] + 1) / (least[k] + 1);
    }
    return sum;
  };
  std::vector<std::size_t> left(judged.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<std::size_t> ordered;
  while (!left.empty()) {
    std::vector<std::size_t> front;
    std::ranges::copy_if(left, std::back_inserter(front), [&](std::size_t i) {
      return std::ranges::none_of(left, [&](std::size_t other) {
        return dominates(rows[other], rows[i]);
      });
    });
    std::ranges::stable_sort(front, {}, cost);
    std::ranges::copy(front, std::back_inserter(ordered));
    if (only_first) break;
    std::erase_if(
        left, [&](std::size_t i) { return std::ranges::count(front, i) > 0; });
  }
  return ordered;
}

// The disks of tips that touch what is seen [mm²].
double visible_area(const slicer::SupportPlan& plan,
                    const slicer::VisibleSurface& seen) {
  double area = 0;
  for (const slicer::Support& support : plan.supports) {
    const double disk = std::numbers::pi / 4 * support.tip * support.tip;
    if (seen.is_at(support.contact)) area += disk;
    if (support.end == slicer::SupportEnd::kPart &&
        seen.is_at(support.path.back())) {
      area += disk;
    }
  }
  return area;
}

class Search {
 public:
  Search(const csg::Scene& scene, const Request& request,
         const Machine& machine, const OrientOptions& options)
      : scene_(scene),
        request_(request),
        machine_(machine),
        settings_(settings_for_search(request, machine)),
        sizes_(support_sizes(
            options.sizes.value_or(slicer::SupportSizes{.tip = 0}), machine)),
        options_(options),
        steps_(options.directions + options.planned) {}

  OrientResult find() {
    OrientResult result;
    std::vector<JudgedDirection> judged = find_quickly();
    result.judged = judged.size();
    keep_fitting(judged);
    result.is_stopped = is_stopped_;
    result.has_visible =
        std::ranges::any_of(scene_.instances, &csg::Instance::is_visible);
    if (judged.empty()) return result;
    std::vector<JudgedDirection> best = best_of(judged);
    for_each_index(best.size(), [&](std::size_t i) {
      if (stops()) return;
      plan_supports(best[i]);
      step_on();
    });
    result.is_stopped = is_stopped_;
    if (is_drawn(best.front())) result.drawn = best.front();
    std::vector<JudgedDirection> planned;
    std::ranges::copy_if(best, std::back_inserter(planned),
                         &JudgedDirection::is_planned);
    result.planned = planned.size();
    keep_fitting(planned);
    if (!planned.empty()) {
      result.listed = front_of(planned, &print_figures);
    } else {
      result.listed = front_of(judged, &quick_figures);
    }
    return result;
  }

 private:
  // Each direction is sliced by one thread, as a whole print in layers of one
  // thickness.
  static slicer::Settings settings_for_search(const Request& request,
                                              const Machine& machine) {
    slicer::Settings settings = settings_of(request, machine);
    settings.threads = 1;
    settings.cusp = 0;
    settings.greatest_thickness = 0;
    settings.written = {};
    settings.min_feature = 0;
    settings.finds_makers = false;
    settings.contour = slicer::ContourMode::kFaithful;
    return settings;
  }

  bool fits(const JudgedDirection& one) const {
    return !machine_.printer ||
           slicer::fits(*machine_.printer, Vec3(one.base, one.height));
  }

  // Leaves out what the printer does not build, where it builds some.
  void keep_fitting(std::vector<JudgedDirection>& all) const {
    const auto is_fit = [&](const JudgedDirection& one) { return fits(one); };
    if (std::ranges::none_of(all, is_fit)) return;
    std::erase_if(all, std::not_fn(is_fit));
  }

  // The first axis is z.
  static bool is_drawn(const JudgedDirection& one) {
    return one.up == Vec3(0, 0, 1);
  }

  template <typename Figures>
  static std::vector<JudgedDirection> front_of(
      const std::vector<JudgedDirection>& judged, const Figures& figures) {
    std::vector<JudgedDirection> front;
    for (const std::size_t i : in_order(judged, figures, true)) {
      front.push_back(judged[i]);
    }
    return front;
  }

  // Directions without supports; as drawn first.
  std::vector<JudgedDirection> find_quickly() {
    const auto coarse = static_cast<std::size_t>(
        kCoarseShare * static_cast<double>(options_.directions));
    std::vector<JudgedDirection> judged = judge_all(spread_directions(coarse));
    if (is_stopped_) return judged;
    const double step =
        std::sqrt(4 * std::numbers::pi / static_cast<double>(judged.size()));
    std::vector<Vec3> finer;
    for (const std::size_t i : in_order(judged, &quick_figures, false)) {
      if (judged.size() + finer.size() + kNeighbours > options_.directions) {
        break;
      }
      std::ranges::copy(neighbours_of(judged[i].up, step / 2),
                        std::back_inserter(finer));
    }
    std::ranges::move(judge_all(finer), std::back_inserter(judged));
    return judged;
  }

  // Those for which supports are planned; as drawn first.
  std::vector<JudgedDirection> best_of(
      const std::vector<JudgedDirection>& judged) const {
    std::vector<std::size_t> order = in_order(judged, &quick_figures, false);
    order.resize(std::min(order.size(), options_.planned));
    std::vector<JudgedDirection> best;
    best.push_back(judged.front());
    for (const std::size_t i : order) {
      if (i != 0) best.push_back(judged[i]);
    }
    return best;
  }

  // What counts before there are supports, and with them.
  static std::array<double, 3> quick_figures(const JudgedDirection& one) {
    return {one.overhang, one.cups, one.height};
  }
  static std::array<double, 6> print_figures(const JudgedDirection& one) {
    return {static_cast<double>(one.unheld),
            one.contact_area,
            one.visible_area,
            one.support_volume,
            one.cups,
            one.height};
  }

  csg::Scene turned(Vec3 up) const {
    csg::Scene scene = scene_;
    csg::turn_scene(scene, slicer::turn_upwards(up));
    return scene;
  }

  // Those that are judged before the search is stopped.
  std::vector<JudgedDirection> judge_all(const std::vector<Vec3>& directions) {
    std::vector<std::optional<JudgedDirection>> all(directions.size());
    for_each_index(directions.size(), [&](std::size_t i) {
      if (stops()) return;
      JudgedDirection one;
      one.up = in_thousandths(directions[i]);
      judge(one);
      all[i] = one;
      step_on();
    });
    std::vector<JudgedDirection> judged;
    for (const auto& one : all) {
      if (one) judged.push_back(*one);
    }
    return judged;
  }

  bool stops() {
    if (options_.should_stop && options_.should_stop()) is_stopped_ = true;
    return is_stopped_;
  }

  void judge(JudgedDirection& one) const {
    slicer::Settings settings = settings_;
    settings.layer_thickness = std::max(settings.layer_thickness, kCoarseLayer);
    slicer::LayerDrain sink;
    Diagnostics unshown;
    const csg::Scene scene = turned(one.up);
    const slicer::SliceReport report = slicer::slice(
        scene, slicer::plan_layers(scene, settings), settings, sink, unshown);
    one.base = Vec2(report.box.size());
    one.height = report.box.size().z;
    for (const slicer::Finding& finding : report.print->findings) {
      if (finding.is_minor) continue;
      switch (finding.kind) {
        case slicer::FindingKind::kIsland:
        case slicer::FindingKind::kLoosePart:
          ++one.islands;
          one.overhang += finding.area;
          break;
        case slicer::FindingKind::kOverhang:
          one.overhang += finding.area;
          break;
        case slicer::FindingKind::kSuctionCup:
          one.cups += finding.volume;
          break;
        case slicer::FindingKind::kResinTrap:
          break;  // the same in all directions
      }
    }
  }

  void plan_supports(JudgedDirection& one) const {
    const csg::Scene scene = turned(one.up);
    const std::vector<slicer::Layer> layers =
        slicer::all_layers(scene, settings_);
    slicer::SupportPlan plan;
    // Where nothing hangs it stands on the bed, without supports.
    if (one.islands > 0 || one.overhang > 0) {
      plan = slicer::plan_supports(layers, sizes_,
                                   marked_solids(scene, layers, request_));
      one.contacts = plan.supports.size();
      one.contact_area = plan.contact_area();
      if (const auto seen = slicer::VisibleSurface::of(scene, layers)) {
        one.visible_area = visible_area(plan, *seen);
      }
      one.support_volume = plan.volume();
      one.unheld = plan.unheld.size() + plan.unwanted.size();
      if (one.contacts > 0) one.height += layers.front().bottom - plan.bed;
    }
    one.layers = static_cast<std::size_t>(
        std::ceil(one.height / settings_.layer_thickness));
    if (machine_.printer) {
      one.seconds = slicer::estimate_print(machine_, settings_.layer_thickness,
                                           one.layers, 0, 0)
                        .seconds;
    }
    if (options_.draw) one.picture = options_.draw(layers, plan);
    one.is_planned = true;
  }

  void step_on() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (options_.on_progress) {
      options_.on_progress(std::min(done_, steps_), steps_);
    }
  }

  const csg::Scene& scene_;
  const Request& request_;
  const Machine& machine_;
  const slicer::Settings settings_;
  const slicer::SupportSizes sizes_;
  const OrientOptions& options_;
  const std::size_t steps_;
  std::atomic<bool> is_stopped_ = false;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

std::optional<OrientResult> find_orientations(Compilation& c,
                                              const OrientOptions& options) {
  c.request.geometry.turn = 0;
  c.request.compensation.drop_bed();
  c.report.machine = choose_machine(c.request.output, c.file_access());
  const auto lowered = make_geometry(c);
  if (!lowered) return std::nullopt;
  if (lowered->scene() == nullptr) {
    throw GeometryError("The design is flat: a solid was expected");
  }
  return Search(*lowered->scene(), c.request, c.report.machine, options).find();
}

std::optional<FoundDirection> find_direction(const Request& request,
                                             std::size_t evaluation_stack,
                                             TemporaryFiles& files) {
  Request searched = request;
  searched.geometry.searched_direction = 0;
  searched.supports.reset();
  Compilation compilation(searched, files);
  compilation.evaluation_stack = evaluation_stack;
  OrientOptions options;
  options.sizes = request.supports;
  std::optional<OrientResult> found;
  try {
    found = find_orientations(compilation, options);
  } catch (const InternalError&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
  if (!found) return std::nullopt;
  const unsigned rank = request.geometry.searched_direction;
  if (rank > found->listed.size()) {
    throw GeometryError(
        fmt::format("--orient {}: 'lamina orient' lists {} of this design",
                    rank, counted(found->listed.size(), "direction")));
  }
  return FoundDirection{found->listed[rank - 1].up, found->judged};
}

std::string direction_text(Vec3 up) {
  up = in_thousandths(up);
  return fmt::format("{:g},{:g},{:g}", up.x, up.y, up.z);
}

}  // namespace lamina::compiler
