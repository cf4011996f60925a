#include "tests/support/scene_sections.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "csg/boundary/leaf_mesh.h"
#include "plane/tie_distance.h"
#include "slicer/slice/slice.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::support {
namespace {

using plane::Contours;

// Loops may touch themselves where rounding has faces a little apart, by less
// than a tie; nothing crosses in any case.
bool is_nearness(ContourDefect::Kind kind) {
  using Kind = ContourDefect::Kind;
  return kind == Kind::kTouchesItself || kind == Kind::kOverlap;
}

// What is left of a loop where vertices are left out may be as small as it
// likes.
void expect_sound(const slicer::Layer& layer, double tolerance,
                  const std::string& design) {
  ContourRules rules;
  if (tolerance > 0) rules.least_area = 0;
  for (const auto& defect : find_defects(layer.contours, rules)) {
    if (is_nearness(defect.kind)) continue;
    throw BrokenLaw{
        fmt::format("z = {}: {}\n{}", layer.section_z, defect.message, design)};
  }
}

void expect_within(const Box3& box, const slicer::Layer& layer,
                   const std::string& design) {
  for (const Vec2& point : layer.contours.points) {
    if (point.x >= box.low.x - kDoubt && point.x <= box.high.x + kDoubt &&
        point.y >= box.low.y - kDoubt && point.y <= box.high.y + kDoubt) {
      continue;
    }
    throw BrokenLaw{fmt::format("z = {}: ({}, {}) is out of the box\n{}",
                                layer.section_z, point.x, point.y, design)};
  }
}

void expect_no_repairs(const slicer::SliceReport& report,
                       const std::string& design) {
  const auto& sweep = report.sweep;
  if (sweep.unbalanced_clusters + sweep.repaired_clusters +
          sweep.capped_clusters + report.open_paths ==
      0) {
    return;
  }
  throw BrokenLaw{fmt::format(
      "{} unbalanced, {} repaired, {} capped clusters, {} open paths\n{}",
      sweep.unbalanced_clusters, sweep.repaired_clusters, sweep.capped_clusters,
      report.open_paths, design)};
}

std::optional<Design> read(const std::string& design) {
  try {
    return Design::from_text(design);
  } catch (const std::runtime_error& error) {
    throw Refused{fmt::format("{}\n{}", error.what(), design)};
  }
}

// The sides of one height, asked point by point.
class Height {
 public:
  Height(const Contours& result, std::vector<const Contours*> operands,
         const Rule& rule)
      : result_(result), operands_(std::move(operands)), rule_(rule) {}

  // Where the rule is broken.
  std::optional<Vec2> find_fault() {
    if (ask_around(result_)) return fault_;
    for (const Contours* operand : operands_) {
      if (ask_around(*operand)) return fault_;
    }
    return std::nullopt;
  }

 private:
  // True: at fault.
  bool ask_around(const Contours& contours) {
    constexpr double kBeside = 2 * kDoubt;
    for (std::size_t l = 0; l < contours.loop_count(); ++l) {
      const auto loop = contours.loop(l);
      Vec2 sum(0);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 from = loop[i];
        const Vec2 along = loop[(i + 1) % loop.size()] - from;
        const double length = std::hypot(along.x, along.y);
        sum += from;
        if (length < kBeside) continue;
        const Vec2 aside = Vec2(-along.y, along.x) * (kBeside / length);
        // Off the middle, where edges of round designs often cross.
        const Vec2 place = from + 0.4391 * along;
        if (ask(place + aside) || ask(place - aside)) return true;
      }
      if (ask(sum / static_cast<double>(loop.size()))) return true;
    }
    return false;
  }

  bool ask(const Vec2& point) {
    std::vector<bool> is_inside;
    for (const Contours* operand : operands_) {
      is_inside.push_back(contains(*operand, point));
    }
    if (rule_(is_inside) == contains(result_, point)) return false;
    // Walls and gaps thinner than that may be there or not: which faces are one
    // depends on the axis that they are square to.
    if (distance_to_edges(result_, point) < kDoubt) return false;
    for (const Contours* operand : operands_) {
      if (distance_to_edges(*operand, point) < kDoubt) return false;
    }
    fault_ = point;
    return true;
  }

  const Contours& result_;
  std::vector<const Contours*> operands_;
  const Rule& rule_;
  Vec2 fault_{0};
};

}  // namespace

std::vector<double> clear_heights(const std::string& design,
                                  const std::vector<double>& heights) {
  constexpr double kRounding = 1e-11;
  std::vector<double> clear = heights;
  const auto read_design = read(design);
  const csg::Scene& scene = read_design->scene();
  for (const csg::Instance& instance : scene.instances) {
    for (const Vec3& vertex :
         csg::explicit_mesh(scene.leaves[instance.leaf]).vertices) {
      const Vec3 placed = instance.world_from_leaf * Vec4(vertex, 1);
      std::erase_if(clear, [&](double height) {
        const double distance = std::abs(placed.z - height);
        return distance > kRounding && distance < kDoubt;
      });
    }
  }
  return clear;
}

Sections sections_of(const std::string& design,
                     const std::vector<double>& heights, double pitch) {
  slicer::Settings settings;
  settings.heights = heights;
  settings.ray_pitch = pitch;
  settings.tolerance = 0;
  settings.threads = 1;
  return sliced(design, settings);
}

Sections sliced(const std::string& design, const slicer::Settings& settings) {
  const auto read_design = read(design);
  const csg::Scene& scene = read_design->scene();
  if (scene.instances.empty()) return Sections(settings.heights.size());
  LayerList list;
  Diagnostics diagnostics;
  expect_no_repairs(slicer::slice(scene, slicer::plan_layers(scene, settings),
                                  settings, list, diagnostics),
                    design);
  Sections sections;
  for (slicer::Layer& layer : list.layers) {
    expect_sound(layer, settings.tolerance, design);
    expect_within(scene.box, layer, design);
    sections.push_back(std::move(layer.contours));
  }
  return sections;
}

void expect_rule(const std::string& law, const Sections& result,
                 const std::vector<Sections>& operands, const Rule& rule) {
  for (std::size_t h = 0; h < result.size(); ++h) {
    std::vector<const Contours*> contours;
    for (const Sections& operand : operands) contours.push_back(&operand[h]);
    const auto fault =
        Height(result[h], std::move(contours), rule).find_fault();
    if (!fault) continue;
    throw BrokenLaw{fmt::format(
        "{}: broken in section {} at ({}, {}), which is {}", law, h, fault->x,
        fault->y, contains(result[h], *fault) ? "inside" : "outside")};
  }
}

void expect_same(const std::string& law, const Sections& result,
                 const Sections& operand) {
  expect_rule(law, result, {operand},
              [](const std::vector<bool>& in) { return bool{in[0]}; });
}

void expect_equal_areas(const std::string& law,
                        const std::vector<Sections>& left,
                        const std::vector<Sections>& right) {
  for (std::size_t h = 0; h < left[0].size(); ++h) {
    double difference = 0;
    double perimeter = 0;
    const auto add = [&](const std::vector<Sections>& side, double sign) {
      for (const Sections& each : side) {
        difference += sign * total_area(each[h]);
        perimeter += total_perimeter(each[h]);
      }
    };
    add(left, 1);
    add(right, -1);
    if (std::abs(difference) <= 2 * kTieDistance * (perimeter + 1)) {
      continue;
    }
    throw BrokenLaw{fmt::format("{}: areas differ by {} mm² in section {}", law,
                                difference, h)};
  }
}

Sections mapped(Sections sections, const std::function<Vec2(Vec2)>& map) {
  for (Contours& contours : sections) {
    for (Vec2& point : contours.points) point = map(point);
  }
  return sections;
}

}  // namespace lamina::support
