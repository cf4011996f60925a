#include "csg/boundary/boundary_faces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/plane_section.h"
#include "csg/boundary/program_region.h"
#include "csg/mesh/box_tree.h"
#include "plane/program/program_state.h"
#include "plane/program/ternary_program.h"
#include "plane/region/boolean.h"
#include "plane/tie_distance.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;
using Side = WindowSection::Side;

Box3 expand(const Box3& box) {
  // A window's box grows by less, so that a leaf that misses this box has no
  // face in the window.
  constexpr double kMargin = 4 * kTieDistance;
  return {box.low - kMargin, box.high + kMargin};
}

using IsWanted = std::function<bool(const Box3&)>;
using Take = std::function<void(BoundaryFace)>;

// Returns the instances, those first whose boxes' middles are farthest from the
// scene's.
std::vector<std::uint32_t> outermost_first(const Scene& scene) {
  const auto twice_middle = [](const Box3& box) { return box.low + box.high; };
  const Vec3 middle = twice_middle(scene.box);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Vec3 off = twice_middle(scene.instances[i].box) - middle;
    order.emplace_back(-glm::length(off), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> instances;
  instances.reserve(order.size());
  for (const auto& [distance, i] : order) instances.push_back(i);
  return instances;
}

class Finder {
 public:
  Finder(const Scene& scene, const IsWanted& is_wanted, const Take& take)
      : scene_(scene),
        is_wanted_(is_wanted),
        take_(take),
        state_(program_of(scene)),
        program_(program_of(scene), plane::Ternary::kFalse) {
    for (const Instance& instance : scene.instances) {
      leaves_.emplace_back(scene.leaves[instance.leaf],
                           instance.world_from_leaf);
      boxes_.push_back(expand(instance.box));
    }
  }

  void find() {
    const BoxTree tree(boxes_);
    for (const std::uint32_t instance : outermost_first(scene_)) {
      self_ = instance;
      if (!is_wanted_(boxes_[self_]) || leaf().tree.nodes().empty()) continue;
      std::vector<std::uint32_t> near;
      tree.visit([&](const Box3& box) { return do_meet(box, boxes_[self_]); },
                 [&](std::uint32_t other) {
                   program_.set(other, plane::Ternary::kUnknown);
                   if (other != self_) near.push_back(other);
                 });
      descend(0, near);
      program_.set(self_, plane::Ternary::kFalse);
      for (const std::uint32_t other : near) {
        program_.set(other, plane::Ternary::kFalse);
      }
    }
  }

 private:
  const PlacedLeaf& leaf() const { return leaves_[self_]; }

  // The part of a leaf's surface that meets no other surface lies wholly inside
  // or wholly outside of each other leaf.
  //
  // unknown  instances of which it is not yet known
  void descend(std::uint32_t index, std::span<const std::uint32_t> unknown) {
    const BoxTree::Node& node = leaf().tree.nodes()[index];
    if (!is_wanted_(node.box)) return;
    const Settled settled = settle(node.box, unknown);
    if (program_.is_decided()) {
      // Solid on both sides, or empty.
    } else if (settled.unknown.empty() && is_embedded()) {
      take_all(node);
    } else if (node.size > 1) {
      descend(index + 1, settled.unknown);
      descend(index + 1 + leaf().tree.nodes()[index + 1].size, settled.unknown);
    } else {
      for (const std::uint32_t face : leaf().tree.items(node)) {
        judge(face, settled.unknown);
      }
    }
    forget(settled);
  }

  struct Settled {
    std::vector<std::uint32_t> unknown;
    std::vector<std::uint32_t> around;
    std::vector<std::uint32_t> apart;
  };

  Settled settle(const Box3& box, std::span<const std::uint32_t> unknown) {
    Settled settled;
    const Box3 reach = expand(box);
    for (const std::uint32_t other : unknown) {
      if (program_.is_decided()) break;
      if (has_face_in(other, reach)) {
        settled.unknown.push_back(other);
      } else {
        note(other, contains(leaves_[other], box.low), settled);
      }
    }
    return settled;
  }

  void note(std::uint32_t other, bool is_around, Settled& settled) {
    if (is_around) {
      settled.around.push_back(other);
      state_.flip(other, true);
      program_.set(other, plane::Ternary::kTrue);
    } else {
      settled.apart.push_back(other);
      program_.set(other, plane::Ternary::kFalse);
    }
  }

  void forget(const Settled& settled) {
    for (const std::uint32_t other : settled.around) {
      state_.flip(other, false);
      program_.set(other, plane::Ternary::kUnknown);
    }
    for (const std::uint32_t other : settled.apart) {
      program_.set(other, plane::Ternary::kUnknown);
    }
  }

  bool has_face_in(std::uint32_t other, const Box3& box) const {
    bool is_found = false;
    leaves_[other].tree.visit(
        [&](const Box3& face) { return !is_found && do_meet(face, box); },
        [&](std::uint32_t) { is_found = true; });
    return is_found;
  }

  // Whether each face separates inside from outside of its own leaf.
  bool is_embedded() const {
    return !scene_.leaves[scene_.instances[self_].leaf].may_overlap_itself;
  }

  void take_all(const BoxTree::Node& node) {
    for (const std::uint32_t face : leaf().tree.items(node)) take_whole(face);
  }

  // Only this leaf is unknown, and decides the program.
  void take_whole(std::uint32_t face) {
    const Vec3 normal = leaf().faces.normal_of(face);
    if (normal == Vec3(0)) return;
    const bool is_reversed = state_.value();  // solid outside of the leaf
    BoundaryFace result{is_reversed ? -normal : normal,
                        leaf().faces.contours_of(face)};
    if (is_reversed) {
      for (auto& contour : result.contours) {
        std::reverse(contour.begin(), contour.end());
      }
    }
    take_(std::move(result));
  }

  // Judges one face by the instances near it that its parent in the tree left.
  void judge(std::uint32_t face, std::span<const std::uint32_t> unknown) {
    const Vec3 normal = leaf().faces.normal_of(face);
    const Box3 box = leaf().faces.box_of(face);
    if (normal == Vec3(0) || !is_wanted_(box)) return;
    const Settled settled = settle(box, unknown);
    if (program_.is_decided()) {
      // Solid on both sides, or empty.
    } else if (settled.unknown.empty() && is_embedded()) {
      take_whole(face);
    } else {
      cut(face, normal, settled.unknown);
    }
    forget(settled);
  }

  // Solves the plane problem of one face.
  void cut(std::uint32_t face, Vec3 normal,
           std::span<const std::uint32_t> others) {
    const auto corners = leaf().faces.contours_of(face);
    const Plane plane(corners[0][0], normal);
    Region outline;
    Box2 window;
    for (const auto& contour : corners) {
      Contour& flat = outline.contours.emplace_back();
      for (const Vec3 corner : contour) {
        flat.push_back(plane.flatten(corner));
        window.add(flat.back());
      }
    }

    std::vector<Cut> cuts;
    std::vector<Region> earlier;  // faces in this plane whose turn was before
    const auto add = [&](std::uint32_t other) {
      WindowSection section(leaves_[other], plane, window);
      if (section.is_touched()) {
        add_earlier(other, section.faces(), face, plane, earlier);
      }
      cuts.push_back({other, std::move(section)});
    };
    // One leaf around the whole window often decides the program; the others
    // need no sections then.
    Settled known;
    for (const std::uint32_t other : others) {
      add(other);
      note_uniform(cuts.back(), known);
      if (program_.is_decided()) break;
    }
    const bool is_decided = program_.is_decided();
    forget(known);
    if (is_decided) return;
    if (!is_embedded()) add(self_);

    if (!earlier.empty()) {
      earlier.insert(earlier.begin(), outline);
      outline = plane::subtract(earlier);
    }
    if (outline.is_empty()) return;
    if (is_embedded()) program_.set(self_, plane::Ternary::kFalse);
    const auto outside = evaluate(cuts, Side::kAbove, outline);
    if (is_embedded()) {
      state_.flip(self_, true);
      program_.set(self_, plane::Ternary::kTrue);
    }
    const auto inside = evaluate(cuts, Side::kBelow, outline);
    if (is_embedded()) state_.flip(self_, false);
    program_.set(self_, plane::Ternary::kUnknown);
    emit(plane, normal, outline, inside, outside, false);
    emit(plane, -normal, outline, outside, inside, true);
  }

  // Another leaf in the plane of the face. What is asked of a side is kept, and
  // where no vertex lies on the plane both sides are one.
  class Cut {
   public:
    Cut(std::uint32_t instance, WindowSection section)
        : instance_(instance), section_(std::move(section)) {}

    std::uint32_t instance() const { return instance_; }

    std::optional<bool> uniform_value(Side side) {
      Known& known = at(side);
      if (!known.uniform) known.uniform = section_.uniform_value(side);
      return *known.uniform;
    }
    const Region& region(Side side, const Region& outline) {
      Known& known = at(side);
      if (!known.region) {
        known.region = plane::clip(section_.contours(side).contours, outline);
      }
      return *known.region;
    }

   private:
    struct Known {
      std::optional<std::optional<bool>> uniform;
      std::optional<Region> region;
    };

    Known& at(Side side) {
      return known_[section_.is_touched() && side == Side::kAbove ? 1 : 0];
    }

    std::uint32_t instance_;
    WindowSection section_;
    std::array<Known, 2> known_;
  };

  // Notes a leaf that has all of the window inside, or nothing, on both sides
  // of the plane.
  void note_uniform(Cut& cut, Settled& known) {
    if (!program_.matters(cut.instance())) return;
    const auto below = cut.uniform_value(Side::kBelow);
    if (below && below == cut.uniform_value(Side::kAbove)) {
      note(cut.instance(), *below, known);
    }
  }

  std::optional<Region> evaluate(std::vector<Cut>& cuts, Side side,
                                 const Region& outline) {
    Settled settled;
    for (Cut& cut : cuts) {
      if (!program_.matters(cut.instance())) continue;
      const auto value = cut.uniform_value(side);
      if (value) note(cut.instance(), *value, settled);
    }
    std::vector<LiveInstance> live;
    for (Cut& cut : cuts) {
      if (!program_.matters(cut.instance())) continue;
      live.push_back({cut.instance(), cut.region(side, outline)});
    }
    auto value = evaluate_in_window(scene_, state_, live, outline);
    forget(settled);
    return value;
  }

  // Adds the earlier faces in the plane of this one: the first of several gives
  // what they share.
  void add_earlier(std::uint32_t other, std::span<const std::uint32_t> faces,
                   std::uint32_t face, const Plane& plane,
                   std::vector<Region>& earlier) const {
    const LeafFaces& all = leaves_[other].faces;
    for (const std::uint32_t candidate : faces) {
      if (std::pair(other, candidate) >= std::pair(self_, face)) continue;
      Region region;
      bool is_coplanar = true;
      for (const auto& contour : all.contours_of(candidate)) {
        Contour& flat = region.contours.emplace_back();
        for (const Vec3 corner : contour) {
          const double height = plane.height(corner);
          is_coplanar = is_coplanar && std::abs(height) <= kTieDistance;
          flat.push_back(plane.flatten(corner));
        }
      }
      if (!is_coplanar) continue;
      // All counter-clockwise, or opposite faces would cancel.
      if (plane::area(region) < 0) {
        for (Contour& flat : region.contours) {
          std::reverse(flat.begin(), flat.end());
        }
      }
      earlier.push_back(std::move(region));
    }
  }

  // Takes what is solid on one side of the plane and not on the other.
  void emit(const Plane& plane, Vec3 normal, const Region& outline,
            const std::optional<Region>& solid,
            const std::optional<Region>& empty, bool is_reversed) {
    if (!empty) return;
    Region region = solid.value_or(outline);
    if (!empty->is_empty()) {
      const std::array<Region, 2> operands{std::move(region), *empty};
      region = plane::subtract(operands);
    }
    plane::drop_hairlines(region, kTieDistance);
    if (region.is_empty()) return;
    BoundaryFace face{normal, {}};
    for (const Contour& contour : region.contours) {
      auto& lifted = face.contours.emplace_back();
      for (const Vec2 point : contour) lifted.push_back(plane.lift(point));
      if (is_reversed) std::reverse(lifted.begin(), lifted.end());
    }
    take_(std::move(face));
  }

  const Scene& scene_;
  const IsWanted& is_wanted_;
  const Take& take_;
  plane::ProgramState state_;  // of those known to be inside
  plane::TernaryProgram
      program_;  // of all; those that are nowhere near are false
  std::vector<PlacedLeaf> leaves_;
  std::vector<Box3> boxes_;  // of instances
  std::uint32_t self_ = 0;   // the instance whose faces are judged
};

}  // namespace

void visit_boundary_faces(const Scene& scene, const IsWanted& is_wanted,
                          const Take& take) {
  Finder(scene, is_wanted, take).find();
}

Box3 box_of(const BoundaryFace& face) {
  Box3 box;
  for (const auto& contour : face.contours) box.add(contour);
  return box;
}

std::vector<BoundaryFace> boundary_faces(const Scene& scene) {
  std::vector<BoundaryFace> faces;
  visit_boundary_faces(
      scene, [](const Box3&) { return true; },
      [&](BoundaryFace face) { faces.push_back(std::move(face)); });
  return faces;
}

}  // namespace lamina::csg
