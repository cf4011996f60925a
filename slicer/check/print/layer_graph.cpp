#include "slicer/check/print/layer_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "base/text.h"
#include "plane/loop_area.h"
#include "plane/region/boolean.h"
#include "slicer/check/print/pole.h"
#include "slicer/contour/deviation.h"

namespace lamina::slicer {
namespace {

constexpr std::uint32_t kOpen = 0;  // component of the outside

// Overhangs smaller than this, and nearer to what holds them, are no ledges
// [mm², mm].
constexpr double kLeastOverhangArea = 0.05;
constexpr double kLeastOverhang = 0.2;

// Overhangs no farther from each other than twice the reach and this are one
// [mm]: the least distance of the places where they are looked for.
constexpr double kSamePlace = 0.1;

// The pull of a cup grows with its area; a drilled hole of 2 mm has this one
// [mm²].
constexpr double kLeastCupArea = 3.2;

// What a trap smaller than this holds is a droplet [mm³].
constexpr double kLeastTrapVolume = 0.01;

// Two contours each move by so much when they are simplified, and a surface of
// 45° is none that hangs over [mm].
constexpr double kReachSlack = 0.0015;

// Sides of layers that are no farther apart are one [mm]: files round heights,
// and no printer goes by smaller steps.
constexpr double kSameHeight = 0.001;

// A place inside a region: the middle of its longest part on the upright line
// through its box's middle.
Vec2 inner_place(const plane::Contours& region) {
  const double x = box_of(region.points).center().x;
  std::vector<double> crossings;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2& from = loop[k];
      const Vec2& to = loop[k + 1 < loop.size() ? k + 1 : 0];
      if ((from.x <= x) == (to.x <= x)) continue;
      crossings.push_back(from.y +
                          (x - from.x) * (to.y - from.y) / (to.x - from.x));
    }
  }
  std::ranges::sort(crossings);
  Vec2 place = region.points.front();
  double longest = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const double length = crossings[i + 1] - crossings[i];
    if (length <= longest) continue;
    longest = length;
    place = {x, (crossings[i] + crossings[i + 1]) / 2};
  }
  return place;
}

void merge(Finding& kept, const Finding& other) {
  if (other.first_layer < kept.first_layer) {
    kept.first_layer = other.first_layer;
    kept.bottom = other.bottom;
  }
  if (other.last_layer > kept.last_layer) {
    kept.last_layer = other.last_layer;
    kept.top = other.top;
  }
  kept.area = std::max(kept.area, other.area);
  kept.width = std::max(kept.width, other.width);
  kept.volume += other.volume;
  kept.bond = std::min(kept.bond, other.bond);
  kept.box.add(other.box);
}

}  // namespace

std::string_view name_of(FindingKind kind) {
  constexpr std::array<std::string_view, kFindingKinds> kNames = {
      "island", "loose part", "overhang", "suction cup", "resin trap"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string size_text(const Finding& finding) {
  switch (finding.kind) {
    case FindingKind::kIsland:
      return fmt::format(
          "{:.4g} mm², {}", finding.area,
          finding.is_joined
              ? fmt::format("held from layer {} on", finding.last_layer + 1)
              : "never held");
    case FindingKind::kOverhang:
      return fmt::format(
          "{:.4g} mm², reaches out {:.3g} mm{}", finding.area, finding.distance,
          finding.is_weak() ? fmt::format(", {:.0f} % of its layer holds it",
                                          100 * finding.bond)
                            : "");
    default:
      return fmt::format("{:.4g} mm³, {:.4g} mm² at most", finding.volume,
                         finding.area);
  }
}

std::size_t PrintCheck::count(FindingKind kind) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(findings, [kind](const Finding& finding) {
        return finding.kind == kind && !finding.is_minor;
      }));
}

std::size_t PrintCheck::count_minor() const {
  return static_cast<std::size_t>(
      std::ranges::count(findings, true, &Finding::is_minor));
}

std::string PrintCheck::counts(const std::set<FindingKind>& kinds) const {
  std::string text;
  for (const FindingKind kind : kinds) {
    const std::size_t some = count(kind);
    if (some == 0) continue;
    text += text.empty() ? "" : ", ";
    text += counted(some, name_of(kind));
  }
  return text;
}

double reach_of(double self_supporting, double rise) {
  return self_supporting > 0 ? self_supporting
                             : std::max(rise, 0.0) + kReachSlack;
}

double gap_between(double bottom_below, double top_below, double bottom,
                   double top) {
  if (!(bottom_below < top_below && bottom < top)) return 0;
  const double gap = bottom - top_below;
  const double highest = std::max(std::abs(bottom), std::abs(top_below));
  // Both sides are rounded.
  const double slack = kSameHeight + 2 * float32_rounding(highest);
  return std::abs(gap) > slack ? gap : 0;
}

LayerGraph::LayerGraph(const PrintRules& rules)
    : rules_(rules),
      least_width_(std::max(kContactWidth, std::sqrt(rules.least_area) / 2)) {
  Component outside;
  outside.is_anchored = true;
  components_.push_back(outside);
}

void LayerGraph::take(const Layer& layer, const LayerOverlay* overlay) {
  ++layers_;
  const bool is_first = layers_ == 1;
  if (!is_first &&
      gap_between(last_bottom_, last_top_, layer.bottom, layer.top) > 0) {
    lay(Layer(), nullptr);
    overlay = nullptr;
  }
  if (is_first || layer.contours != last_) {
    lay(layer, overlay);
  } else {
    patches_.clear();
    patch_overhangs_.clear();
  }
  last_bottom_ = layer.bottom;
  last_top_ = layer.top;
  last_z_ = layer.section_z;
  extend(layer);
}

// Lays the layer over the last one, in whose place it then is.
void LayerGraph::lay(const Layer& layer, const LayerOverlay* overlay) {
  if (overlay == nullptr) {
    sweep_.start(last_);
    sweep_.lay_over(layer.contours,
                    reach_of(rules_.self_supporting, layer.section_z - last_z_),
                    own_overlay_);
    overlay = &own_overlay_;
  }
  measure_regions(*overlay);
  next_members_.assign(around_.size(), kNone);
  take_solids(layer, *overlay);
  take_voids(layer, *overlay);
  std::swap(members_, next_members_);
  take_overhangs(layer, *overlay);
  last_.points = layer.contours.points;
  last_.ends = layer.contours.ends;
}

// --- Regions ----------------------------------------------------------------

void LayerGraph::measure_regions(const LayerOverlay& overlay) {
  around_ = overlay.around;
  areas_ = overlay.areas;
  double whole = 0;
  for (double& area : areas_) {
    whole += area;
    area = std::abs(area);
  }
  standing_in_.fill(around_.size(), [this](const auto& list) {
    for (std::uint32_t i = 0; i < around_.size(); ++i) {
      if (around_[i] < around_.size()) list(around_[i], i);
    }
  });
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    for (const std::uint32_t loop : standing_in_[i]) {
      areas_[i] -= std::abs(overlay.areas[loop]);
    }
  }
  take_area(whole);
}

void LayerGraph::take_area(double area) {
  constexpr double kRounding = 1e-9;  // share of an area that is not a jump
  if (area > peel_.greatest_area) {
    peel_.greatest_area = area;
    peel_.layer = layers_;
  }
  const double jump = area - last_area_;
  if (layers_ > 1 && jump > std::max(peel_.greatest_jump, kRounding * area)) {
    peel_.greatest_jump = jump;
    peel_.jump_layer = layers_;
  }
  last_area_ = area;
}

// The loops of a region.
plane::Contours LayerGraph::contours_of(const Layer& layer,
                                        std::uint32_t region) const {
  plane::Contours contours;
  contours.add_loop(layer.contours.loop(region));
  for (const std::uint32_t loop : standing_in_[region]) {
    contours.add_loop(layer.contours.loop(loop));
  }
  return contours;
}

double LayerGraph::width_of(const Layer& layer, std::uint32_t region) const {
  double length = perimeter(layer.contours.loop(region));
  for (const std::uint32_t loop : standing_in_[region]) {
    length += perimeter(layer.contours.loop(loop));
  }
  return length > 0 ? 2 * areas_[region] / length : 0;
}

Finding LayerGraph::begin_finding(FindingKind kind, const Layer& layer) const {
  Finding finding;
  finding.kind = kind;
  finding.first_layer = finding.last_layer = finding.layer = layers_;
  finding.bottom = layer.bottom;
  finding.top = layer.top;
  finding.section_z = layer.section_z;
  return finding;
}

void LayerGraph::take_solids(const Layer& layer, const LayerOverlay& overlay) {
  for (const auto& [below, above] : overlay.solids) {
    const std::uint32_t component = root_of(members_[below]);
    std::uint32_t& member = next_members_[above];
    member =
        member == kNone ? component : join_solids(root_of(member), component);
  }
  for (std::uint32_t i = 0; i < around_.size(); ++i) {
    if (around_[i] == kNowhere || next_members_[i] != kNone) continue;
    if (overlay.areas[i] <= 0) continue;
    Finding finding = begin_finding(FindingKind::kLoosePart, layer);
    if (layers_ > 1) {
      finding.area = areas_[i];
      finding.place = pole_of(contours_of(layer, i));
    }
    next_members_[i] = add_component(finding);
    Component& component = components_.back();
    component.is_anchored = layers_ == 1;
    if (component.is_anchored) continue;
    component.island = static_cast<std::uint32_t>(findings_.size());
    findings_.push_back(finding);
    findings_.back().kind = FindingKind::kIsland;
    findings_.back().box.add(Box3{Vec3(finding.place, finding.bottom),
                                  Vec3(finding.place, finding.top)});
  }
}

void LayerGraph::take_voids(const Layer& layer, const LayerOverlay& overlay) {
  const auto component_of = [this](const std::vector<std::uint32_t>& members,
                                   std::uint32_t region) {
    return region == kOutside ? kOpen : root_of(members[region]);
  };
  // The plate closes what the first layer leaves open.
  const std::span<const Overlap> overlaps =
      layers_ == 1 ? std::span<const Overlap>() : overlay.voids;
  for (const auto& [below, above] : overlaps) {
    const std::uint32_t component = component_of(members_, below);
    if (above == kOutside) {
      join_voids(component, kOpen);
      continue;
    }
    std::uint32_t& member = next_members_[above];
    member =
        member == kNone ? component : join_voids(root_of(member), component);
  }
  for (std::uint32_t i = 0; i < around_.size(); ++i) {
    if (around_[i] == kNowhere || next_members_[i] != kNone) continue;
    Finding finding = begin_finding(FindingKind::kSuctionCup, layer);
    finding.place = inner_place(contours_of(layer, i));
    next_members_[i] = add_component(finding);
    components_.back().touches_bed = layers_ == 1;
  }
}

// Adds the layer to what its regions belong to.
void LayerGraph::extend(const Layer& layer) {
  const double thickness = layer.top - layer.bottom;
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    if (members_[i] == kNone) continue;
    members_[i] = root_of(members_[i]);
    Component& component = components_[members_[i]];
    if (component.is_anchored) continue;
    Finding& finding = component.finding;
    finding.last_layer = layers_;
    finding.top = layer.top;
    finding.area = std::max(finding.area, areas_[i]);
    if (finding.width < least_width_) {
      finding.width = std::max(finding.width, width_of(layer, i));
    }
    finding.volume += areas_[i] * thickness;
    const Box2 box = box_of(layer.contours.loop(i));
    finding.box.add(
        Box3{Vec3(box.low, layer.bottom), Vec3(box.high, layer.top)});
  }
}

// --- Components -------------------------------------------------------------

std::uint32_t LayerGraph::add_component(const Finding& finding) {
  const auto number = static_cast<std::uint32_t>(components_.size());
  Component component;
  component.parent = number;
  component.finding = finding;
  components_.push_back(component);
  return number;
}

std::uint32_t LayerGraph::root_of(std::uint32_t component) {
  while (components_[component].parent != component) {
    component = components_[component].parent =
        components_[components_[component].parent].parent;
  }
  return component;
}

// Joins two roots; returns the one of both.
std::uint32_t LayerGraph::join_solids(std::uint32_t a, std::uint32_t b) {
  if (a == b) return a;
  // What is anchored stays, else what is older.
  const bool keeps_a = components_[a].is_anchored != components_[b].is_anchored
                           ? components_[a].is_anchored
                           : a < b;
  const std::uint32_t kept = keeps_a ? a : b;
  const std::uint32_t other = keeps_a ? b : a;
  components_[other].parent = kept;
  end_island(other);
  if (!components_[kept].is_anchored) {
    merge(components_[kept].finding, components_[other].finding);
  }
  return kept;
}

// The island of a component has met another part in the layer in hand.
void LayerGraph::end_island(std::uint32_t component) {
  const std::uint32_t island = components_[component].island;
  if (island == kNone) return;
  const Finding& now = components_[component].finding;
  Finding& finding = findings_[island];
  finding.is_joined = true;
  finding.last_layer = now.last_layer;
  finding.top = now.top;
  finding.box = now.box;
  finding.width = now.width;
  finding.is_minor =
      is_below_pixel(now) ||
      (finding.area < kPeakArea && finding.last_layer == finding.first_layer);
}

// Whether no layer of it hardens a pixel, or leaves one open.
bool LayerGraph::is_below_pixel(const Finding& finding) const {
  return finding.area < rules_.least_area || finding.width < least_width_;
}

std::uint32_t LayerGraph::join_voids(std::uint32_t a, std::uint32_t b) {
  if (a == b) return a;
  const std::uint32_t kept = std::min(a, b);
  const std::uint32_t other = std::max(a, b);
  components_[other].parent = kept;
  if (kept == kOpen) {
    add_cup(components_[other]);
  } else {
    merge(components_[kept].finding, components_[other].finding);
    components_[kept].touches_bed |= components_[other].touches_bed;
  }
  return kept;
}

// A void that a way now leads out of was closed until here.
void LayerGraph::add_cup(const Component& component) {
  Finding cup = component.finding;
  cup.is_minor = cup.area < kLeastCupArea;
  findings_.push_back(cup);
}

// --- Overhangs --------------------------------------------------------------

void LayerGraph::take_overhangs(const Layer& layer,
                                const LayerOverlay& overlay) {
  const std::size_t before = patches_.size();
  const Vec2 margin(kSamePlace / 2 + reach_of(rules_.self_supporting,
                                              layer.section_z - last_z_));
  for (const Overhang& overhang : overlay.overhangs) {
    Finding finding = begin_finding(FindingKind::kOverhang, layer);
    finding.area = overhang.area;
    finding.distance = overhang.distance;
    finding.place = overhang.place;
    if (overhang.distance > kFarReach) {
      finding.bond = bond_of(layer, overhang.region);
    }
    finding.box = {Vec3(overhang.box.low, layer.bottom),
                   Vec3(overhang.box.high, layer.top)};
    const std::uint32_t number = overhang_sets_.add();
    overhangs_.push_back(finding);
    patches_.push_back({overhang.box.low - margin, overhang.box.high + margin});
    patch_overhangs_.push_back(number);
  }
  if (!overlay.overhangs.empty()) {
    const std::vector<std::uint32_t>& firsts = touching_.find(patches_);
    for (std::size_t i = 0; i < firsts.size(); ++i) {
      join_overhangs(patch_overhangs_[i], patch_overhangs_[firsts[i]]);
    }
  }
  const auto kept = static_cast<std::ptrdiff_t>(before);
  patches_.erase(patches_.begin(), patches_.begin() + kept);
  patch_overhangs_.erase(patch_overhangs_.begin(),
                         patch_overhangs_.begin() + kept);
}

// Of a region, which is not empty: the share that lies on the layer below.
double LayerGraph::bond_of(const Layer& layer, std::uint32_t region) const {
  const std::array<plane::Region, 2> both = {
      to_region(contours_of(layer, region)), to_region(last_)};
  return plane::area(plane::intersect(both)) / plane::area(both[0]);
}

void LayerGraph::join_overhangs(std::uint32_t a, std::uint32_t b) {
  a = overhang_sets_.find(a);
  b = overhang_sets_.find(b);
  if (a == b) return;
  const auto [kept, other] = std::minmax(a, b);
  overhang_sets_.unite(kept, other);
  Finding& finding = overhangs_[kept];
  const Finding& joined = overhangs_[other];
  const double area = finding.area + joined.area;
  merge(finding, joined);
  finding.area = area;
  if (joined.distance > finding.distance) {
    finding.distance = joined.distance;
    finding.place = joined.place;
    finding.layer = joined.layer;
    finding.section_z = joined.section_z;
  }
}

// --- The end ----------------------------------------------------------------

PrintCheck LayerGraph::finish() {
  // Above the last layer all is open.
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    if (members_[i] == kNone) continue;
    const std::uint32_t root = root_of(members_[i]);
    if (components_[root].finding.kind == FindingKind::kSuctionCup) {
      join_voids(root, kOpen);
    }
  }
  std::vector<bool> is_known(findings_.size());  // as another finding
  for (std::uint32_t i = 1; i < components_.size(); ++i) {
    Component& component = components_[i];
    if (component.parent != i || component.is_anchored) continue;
    Finding& finding = component.finding;
    if (finding.kind == FindingKind::kLoosePart) {
      // Its island was never joined, and is the same.
      if (component.island != kNone) is_known[component.island] = true;
      findings_.push_back(finding);
    } else if (component.touches_bed) {
      add_cup(component);
    } else {
      finding.kind = FindingKind::kResinTrap;
      finding.is_minor = finding.volume < kLeastTrapVolume;
      findings_.push_back(finding);
    }
  }
  for (std::uint32_t i = 0; i < overhangs_.size(); ++i) {
    if (overhang_sets_.find(i) != i) continue;
    Finding& finding = overhangs_[i];
    finding.is_minor =
        finding.area < kLeastOverhangArea && finding.distance < kLeastOverhang;
    findings_.push_back(finding);
  }
  PrintCheck check{.findings = {}, .peel = peel_};
  for (std::size_t i = 0; i < findings_.size(); ++i) {
    if (i < is_known.size() && is_known[i]) continue;
    if (findings_[i].kind != FindingKind::kOverhang &&
        findings_[i].width < kContactWidth) {
      continue;
    }
    Finding& finding = check.findings.emplace_back(findings_[i]);
    switch (finding.kind) {
      case FindingKind::kIsland:
        break;  // judged by all its layers when it ended
      case FindingKind::kOverhang:
        finding.is_minor |= finding.area < rules_.least_area;
        break;
      default:
        finding.is_minor |=
            is_below_pixel(finding) || finding.volume < rules_.least_volume;
    }
  }
  std::ranges::stable_sort(check.findings, {}, [](const Finding& finding) {
    return std::tuple(finding.first_layer, finding.kind, finding.place.x,
                      finding.place.y);
  });
  return check;
}

}  // namespace lamina::slicer
