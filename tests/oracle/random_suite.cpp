#include "tests/oracle/random_suite.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "plane/tie_distance.h"
#include "slicer/contour/layer.h"
#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/world_scene.h"
#include "tests/plane/cascade/section_reference.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

constexpr std::array<double, 3> kPitches = {0.02, 0.0762, 0.5};

// What is asked of designs of a kind.
struct Rules {
  Allowance allowance = kExactAllowance;
  support::ContourRules contour;
  double beside = 1e-7;          // of probes from an edge [mm]
  double least_edge = 1e-5;      // shorter edges are not probed [mm]
  double least_distance = 5e-8;  // of a judged probe from every face [mm]
};

Rules rules_of(RandomKind kind) {
  Rules rules;
  if (kind != RandomKind::kNear) return rules;
  constexpr double kNearDistance = 10 * kTieDistance;
  rules.allowance = {kNearDistance, kNearDistance};
  rules.beside = 2 * kNearDistance;
  rules.least_edge = 10 * kNearDistance;
  rules.least_distance = kNearDistance;
  return rules;
}

// Loops as the kind asks: nothing open, nothing crossing. Where faces may be
// 1e-9 mm apart, so may edges of one loop.
std::string complaint_about(const plane::Contours& contours, RandomKind kind,
                            const Rules& rules) {
  using Kind = support::ContourDefect::Kind;
  for (const auto& defect : support::find_defects(contours, rules.contour)) {
    if (kind == RandomKind::kNear && (defect.kind == Kind::kTouchesItself ||
                                      defect.kind == Kind::kOverlap)) {
      continue;
    }
    return defect.message;
  }
  return {};
}

class Prober {
 public:
  Prober(const csg::Scene& scene, const Rules& rules, std::uint32_t seed)
      : scene_(scene), rules_(rules), reference_(scene), random_(seed) {}

  // Asks beside all edges of a layer and at random places.
  std::string probe_layer(const slicer::Layer& layer, SuiteTally& tally) {
    constexpr int kRandomPlaces = 20;
    // A vertex on the plane is below it, with the product's 1e-9 mm.
    reference_.cut(layer.section_z, layer.section_z + 1e-9);
    contours_ = &layer.contours;
    complaint_.clear();
    for (std::size_t i = 0; i < contours_->loop_count(); ++i) {
      const auto loop = contours_->loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        probe_beside(loop[k], loop[(k + 1) % loop.size()], tally);
      }
    }
    for (const auto& segment : reference_.segments()) {
      probe_beside(segment.from, segment.to, tally);
    }
    const Vec3 size = scene_.box.high - scene_.box.low;
    for (int i = 0; i < kRandomPlaces; ++i) {
      probe(Vec2(scene_.box.low) + Vec2(share() * size.x, share() * size.y),
            tally);
    }
    return complaint_;
  }

 private:
  double share() { return static_cast<double>(random_()) / 0x1p32; }

  void probe_beside(const Vec2& from, const Vec2& to, SuiteTally& tally) {
    const Vec2 along = to - from;
    const double length = std::hypot(along.x, along.y);
    if (length < rules_.least_edge) return;
    const Vec2 aside = Vec2(-along.y, along.x) * (rules_.beside / length);
    const Vec2 place = from + (0.2 + 0.6 * share()) * along;
    probe(place + aside, tally);
    probe(place - aside, tally);
  }

  void probe(const Vec2& point, SuiteTally& tally) {
    ++tally.probes;
    const bool expected = reference_.contains(point);
    if (support::contains(*contours_, point) == expected) return;
    // Another face may pass between the edge and the probe.
    const double distance = reference_.distance(point);
    if (distance < rules_.least_distance || !complaint_.empty()) return;
    complaint_ = fmt::format(
        "({:.17g}, {:.17g}), {:.3g} mm from a face, should be {}", point.x,
        point.y, distance, expected ? "inside" : "outside");
  }

  const csg::Scene& scene_;
  const Rules rules_;
  testing::SectionReference reference_;
  std::mt19937 random_;
  const plane::Contours* contours_ = nullptr;
  std::string complaint_;
};

// Heights away from all vertices; for every other design on the grid, right at
// its faces, where the section is the one just above.
std::vector<double> heights_of(RandomKind kind, std::uint32_t seed,
                               const WorldScene& world, const csg::Scene& scene,
                               std::size_t count) {
  const double low = scene.box.low.z;
  const double high = scene.box.high.z;
  if (kind != RandomKind::kGrid || seed % 2 == 0) {
    return generic_heights(world, low, high, count);
  }
  constexpr double kStep = 0.125;  // half that of the grid
  std::vector<double> heights;
  for (double z = low; z < high && heights.size() < count; z += kStep) {
    heights.push_back(z);
  }
  return heights;
}

bool are_same(const plane::Contours& a, const plane::Contours& b) {
  return a.points == b.points && a.ends == b.ends;
}

// Judges one section at all pitches; most often they give the same loops.
std::string try_section(const ExactRegion& section,
                        const std::array<const slicer::Layer*, 3>& layers,
                        RandomKind kind, const Rules& rules, Prober& prober,
                        SuiteTally& tally) {
  ++tally.sections;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    ++tally.layers;
    const plane::Contours& contours = layers[i]->contours;
    if (i > 0 && are_same(contours, layers[i - 1]->contours)) continue;
    std::string complaint = complaint_about(contours, kind, rules);
    if (complaint.empty()) {
      complaint = judge(section, contours, rules.allowance).complaint;
    }
    if (complaint.empty()) complaint = prober.probe_layer(*layers[i], tally);
    if (!complaint.empty()) {
      return fmt::format("z = {}, pitch {}: {}", layers[i]->section_z,
                         kPitches[i], complaint);
    }
  }
  return {};
}

}  // namespace

std::size_t suite_leaf_count(std::uint32_t seed) { return 2 + seed * 7 % 39; }

std::size_t suite_layer_count(std::uint32_t seed) {
  return 20 + seed * 13 % 41;
}

std::string try_design(RandomKind kind, std::uint32_t seed,
                       std::size_t layer_count, SuiteTally& tally) {
  const std::size_t leaf_count = suite_leaf_count(seed);
  const std::string text = random_design(kind, seed, leaf_count);
  ++tally.designs;
  tally.leaves += leaf_count;
  const support::Design design = support::Design::from_text(text);
  const csg::Scene& scene = design.scene();
  if (scene.instances.empty() || scene.box.is_empty()) {
    ++tally.empty_designs;
    return {};
  }
  const WorldScene world = world_scene(scene);
  const auto heights = heights_of(kind, seed, world, scene, layer_count);
  std::array<std::vector<slicer::Layer>, 3> layers;
  for (std::size_t i = 0; i < kPitches.size(); ++i) {
    layers[i] = support::slice_heights(scene, heights, kPitches[i]);
  }
  const Rules rules = rules_of(kind);
  Prober prober(scene, rules, seed);
  for (std::size_t h = 0; h < heights.size(); ++h) {
    const std::string complaint =
        try_section(exact_section(world, heights[h]),
                    {&layers[0][h], &layers[1][h], &layers[2][h]}, kind, rules,
                    prober, tally);
    if (complaint.empty()) continue;
    ++tally.failures;
    return fmt::format("{}, seed {}, {}\n{}", name_of(kind), seed, complaint,
                       text);
  }
  return {};
}

}  // namespace lamina::oracle
