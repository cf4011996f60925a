#include "csg/boundary/boundary_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/detail/scan_lines.h"
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

}  // namespace

class BoundaryFinder::Search {
 public:
  explicit Search(const Scene& scene)
      : scene_(scene),
        state_(program_of(scene)),
        program_(program_of(scene), plane::Ternary::kFalse),
        leaves_(scene.instances.size()),
        outside_(state_) {
    for (const Instance& instance : scene.instances) {
      boxes_.push_back(expand(instance.box));
    }
  }

  // Visits the faces that are wanted.
  //
  // open  gets those that are open; null where they are to be solved at once
  void find(const IsWanted& is_wanted, const TakeFace& take,
            std::vector<OpenFace>* open) {
    is_wanted_ = &is_wanted;
    take_ = &take;
    open_ = open;
    const BoxTree tree(boxes_);
    for (const std::uint32_t instance : outermost_first(scene_)) {
      self_ = instance;
      if (!is_wanted(boxes_[self_]) || leaf().tree.nodes().empty()) continue;
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

  void solve(const OpenFace& face, const TakeFace& take) {
    take_ = &take;
    with_known(face, [&] { cut(face.face, face.normal, face.others); });
  }

  MeasuredFace measure(const OpenFace& face, std::size_t most_lines) {
    MeasuredFace measured;
    with_known(face, [&] { measured = scan(face, most_lines); });
    return measured;
  }

 private:
  // Does the work while all is known that was when the face was found.
  template <typename Work>
  void with_known(const OpenFace& face, const Work& work) {
    self_ = face.instance;
    program_.set(self_, plane::Ternary::kUnknown);
    for (const std::uint32_t other : face.others) {
      program_.set(other, plane::Ternary::kUnknown);
    }
    Settled settled;
    for (const std::uint32_t other : face.around) note(other, true, settled);
    work();
    forget(settled);
    program_.set(self_, plane::Ternary::kFalse);
    for (const auto* known : {&face.around, &face.others}) {
      for (const std::uint32_t other : *known) {
        program_.set(other, plane::Ternary::kFalse);
      }
    }
  }

  const PlacedLeaf& leaf() { return placed(self_); }

  // Leaves are placed when they are first asked for.
  const PlacedLeaf& placed(std::uint32_t instance) {
    std::unique_ptr<PlacedLeaf>& leaf = leaves_[instance];
    if (!leaf) {
      const Instance& self = scene_.instances[instance];
      leaf = std::make_unique<PlacedLeaf>(scene_.leaves[self.leaf],
                                          self.world_from_leaf);
    }
    return *leaf;
  }

  // The part of a leaf's surface that meets no other surface lies wholly inside
  // or wholly outside of each other leaf.
  //
  // unknown  instances of which it is not yet known
  void descend(std::uint32_t index, std::span<const std::uint32_t> unknown) {
    const BoxTree::Node& node = leaf().tree.nodes()[index];
    if (!(*is_wanted_)(node.box)) return;
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
        note(other, contains(placed(other), box.low), settled);
      }
    }
    return settled;
  }

  void note(std::uint32_t other, bool is_around, Settled& settled) {
    if (is_around) {
      settled.around.push_back(other);
      around_.push_back(other);
      state_.flip(other, true);
      program_.set(other, plane::Ternary::kTrue);
    } else {
      settled.apart.push_back(other);
      program_.set(other, plane::Ternary::kFalse);
    }
  }

  void forget(const Settled& settled) {
    around_.resize(around_.size() - settled.around.size());
    for (const std::uint32_t other : settled.around) {
      state_.flip(other, false);
      program_.set(other, plane::Ternary::kUnknown);
    }
    for (const std::uint32_t other : settled.apart) {
      program_.set(other, plane::Ternary::kUnknown);
    }
  }

  bool has_face_in(std::uint32_t other, const Box3& box) {
    bool is_found = false;
    placed(other).tree.visit(
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
    (*take_)(std::move(result));
  }

  // Judges one face by the instances near it that its parent in the tree left.
  void judge(std::uint32_t face, std::span<const std::uint32_t> unknown) {
    const Vec3 normal = leaf().faces.normal_of(face);
    const Box3 box = leaf().faces.box_of(face);
    if (normal == Vec3(0) || !(*is_wanted_)(box)) return;
    const Settled settled = settle(box, unknown);
    if (program_.is_decided()) {
      // Solid on both sides, or empty.
    } else if (settled.unknown.empty() && is_embedded()) {
      take_whole(face);
    } else if (open_ != nullptr) {
      open_->push_back({self_, face, normal,
                        glm::length(leaf().faces.area_vector_of(face)), box,
                        around_, settled.unknown});
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
      WindowSection section(placed(other), plane, window);
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

  // --- Areas by scan lines
  // ----------------------------------------------------

  // Edges of the face itself and of earlier ones in its plane; those of leaves
  // have their place in live_, and their sides.
  static constexpr std::uint32_t kOutline = 0xffffffff;
  static constexpr std::uint32_t kEarlier = 0xfffffffe;

  // A leaf that divides the window, and its winding numbers: below, above.
  struct LiveLeaf {
    std::uint32_t instance;
    std::array<int, 2> base;  // where a line enters the window
    std::array<int, 2> here{};
  };
  // Where a leaf's edge meets the side of the window on which lines enter.
  struct Entry {
    double v;
    std::uint32_t tag;
    int step;
  };

  // What of the window lies on one side of the plane.
  struct Half {
    double area = 0;  // in the plane's coordinates
    Box3 box;
  };

  MeasuredFace scan(const OpenFace& face, std::size_t most_lines) {
    const auto corners = leaf().faces.contours_of(face.face);
    const Plane plane(corners[0][0], face.normal);
    lines_.clear();
    live_.clear();
    entries_.clear();
    Box2 window;
    for (const auto& contour : corners) {
      Contour flat;
      for (const Vec3 corner : contour) flat.push_back(plane.flatten(corner));
      for (const Vec2 corner : flat) window.add(corner);
      add_contour(flat, kOutline);
    }
    Settled known;
    add_leaves(face, plane, reach_around(window), known);
    std::array<Half, 2> halves;
    MeasuredFace measured;
    if (!program_.is_decided()) {
      measured.is_exact = measure_lines(plane, window, most_lines, halves);
    }
    forget(known);
    measured.edges = lines_.size();
    for (const std::size_t side : {0U, 1U}) {
      const Half& half = halves[side];
      if (half.box.is_empty()) continue;  // hairlines at most
      const double area = half.area * plane.area_factor();
      measured.parts.push_back(
          {side == 0 ? face.normal : -face.normal, area, half.box});
    }
    return measured;
  }

  void add_contour(const Contour& contour, std::uint32_t tag) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 next = contour[i + 1 == contour.size() ? 0 : i + 1];
      lines_.add(contour[i], next, tag);
    }
  }

  // Edges and vertices often lie on the window's border, and edges often lead
  // diagonally to its corners. Lines enter farther out, at odd places, where
  // the rounding of no edge decides.
  static Box2 reach_around(const Box2& window) {
    const Vec2 margin =
        Vec2(0.01371, 0.00883) * window.size() + Vec2(17, 29) * kTieDistance;
    return {window.low - margin, window.high + margin};
  }

  void add_leaves(const OpenFace& face, const Plane& plane, const Box2& reach,
                  Settled& known) {
    std::vector<Region> earlier;
    for (const std::uint32_t other : face.others) {
      add_leaf(other, face, plane, reach, known, earlier);
      if (program_.is_decided()) return;
    }
    if (!is_embedded()) {
      add_leaf(self_, face, plane, reach, known, earlier);
    }
    for (const Region& region : earlier) {
      for (const Contour& contour : region.contours) {
        add_contour(contour, kEarlier);
      }
    }
  }

  void add_leaf(std::uint32_t other, const OpenFace& face, const Plane& plane,
                const Box2& reach, Settled& known,
                std::vector<Region>& earlier) {
    const WindowSection section(placed(other), plane, reach);
    const bool is_touched = section.is_touched();
    if (is_touched) {
      add_earlier(other, section.faces(), face.face, plane, earlier);
    }
    LiveLeaf leaf{other, {section.corner_winding(Side::kBelow), 0}};
    leaf.base[1] =
        is_touched ? section.corner_winding(Side::kAbove) : leaf.base[0];
    std::size_t edges =
        add_edges(section.edges(Side::kBelow), reach, is_touched ? 1 : 3);
    if (is_touched) edges += add_edges(section.edges(Side::kAbove), reach, 2);
    const bool is_inside = leaf.base[0] != 0;
    if (edges == 0 && is_inside == (leaf.base[1] != 0) && other != self_) {
      note(other, is_inside, known);
    } else {
      live_.push_back(leaf);
    }
  }

  // Adds edges of the leaf that will be the next in live_.
  //
  // sides    1: below, 2: above, 3: both
  // returns  how many there are
  std::size_t add_edges(const std::vector<WindowSection::Edge>& edges,
                        const Box2& reach, std::uint32_t sides) {
    const auto tag = static_cast<std::uint32_t>(live_.size()) << 2 | sides;
    for (const auto& [begin, end] : edges) {
      lines_.add(begin, end, tag);
      if ((begin.x < reach.low.x) == (end.x < reach.low.x)) continue;
      const double share = (reach.low.x - begin.x) / (end.x - begin.x);
      const double v = begin.y + share * (end.y - begin.y);
      if (v > reach.low.y)
        entries_.push_back({v, tag, begin.x < end.x ? 1 : -1});
    }
    return edges.size();
  }

  bool measure_lines(const Plane& plane, const Box2& window,
                     std::size_t most_lines, std::array<Half, 2>& halves) {
    const double entry = reach_around(window).low.x;
    std::ranges::sort(entries_, {}, &Entry::v);
    outside_ = state_;
    if (is_embedded()) state_.flip(self_, true);
    std::size_t next = 0;
    const bool is_exact = lines_.visit(
        window.low.y, window.high.y, most_lines,
        [&](double low, double high,
            std::span<const ScanLines::Crossing> crossings) {
          const double middle = 0.5 * (low + high);
          for (; next < entries_.size() && entries_[next].v < middle; ++next) {
            enter(entries_[next]);
          }
          measure_line({low, high}, entry, crossings, plane, halves);
        });
    if (is_embedded()) state_.flip(self_, false);
    return is_exact;
  }

  void enter(const Entry& entry) {
    LiveLeaf& leaf = live_[entry.tag >> 2];
    if ((entry.tag & 1) != 0) leaf.base[0] += entry.step;
    if ((entry.tag & 2) != 0) leaf.base[1] += entry.step;
  }

  // Changes a leaf's winding number on one side of the plane.
  void turn(LiveLeaf& leaf, std::size_t side, int winding) {
    const bool was_inside = leaf.here[side] != 0;
    leaf.here[side] = winding;
    if (was_inside == (winding != 0)) return;
    (side == 0 ? state_ : outside_).flip(leaf.instance, winding != 0);
  }

  void measure_line(std::array<double, 2> slab, double entry,
                    std::span<const ScanLines::Crossing> crossings,
                    const Plane& plane, std::array<Half, 2>& halves) {
    for (LiveLeaf& leaf : live_) {
      for (const std::size_t side : {0U, 1U}) turn(leaf, side, leaf.base[side]);
    }
    int outline = 0;
    int earlier = 0;
    std::array<const ScanLines::Crossing*, 2> begin{};
    for (const ScanLines::Crossing& crossing : crossings) {
      const std::uint32_t tag = crossing.edge->tag;
      const int step = crossing.edge->step();
      if (tag == kOutline) {
        outline += step;
      } else if (tag == kEarlier) {
        earlier += step;
      } else if (crossing.u >= entry) {
        LiveLeaf& leaf = live_[tag >> 2];
        if ((tag & 1) != 0) turn(leaf, 0, leaf.here[0] + step);
        if ((tag & 2) != 0) turn(leaf, 1, leaf.here[1] + step);
      }
      const bool is_open = outline != 0 && earlier == 0;
      const bool inside = is_open && state_.value();
      const bool outside = is_open && outside_.value();
      for (const std::size_t side : {0U, 1U}) {
        const bool is_boundary =
            inside != outside && (side == 0 ? inside : outside);
        if (is_boundary == (begin[side] != nullptr)) continue;
        if (is_boundary) {
          begin[side] = &crossing;
        } else {
          add_part(slab, *begin[side], crossing, plane, halves[side]);
          begin[side] = nullptr;
        }
      }
    }
    for (LiveLeaf& leaf : live_) {
      for (const std::size_t side : {0U, 1U}) turn(leaf, side, 0);
    }
  }

  static void add_part(std::array<double, 2> slab,
                       const ScanLines::Crossing& begin,
                       const ScanLines::Crossing& end, const Plane& plane,
                       Half& half) {
    const double width = end.u - begin.u;
    const double height = slab[1] - slab[0];
    half.area += width * height;
    if (width <= kTieDistance || height <= kTieDistance) return;
    for (const ScanLines::Edge* edge : {begin.edge, end.edge}) {
      for (const double v : slab) half.box.add(plane.lift(edge->at(v)));
    }
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
                   std::vector<Region>& earlier) {
    const LeafFaces& all = placed(other).faces;
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
    (*take_)(std::move(face));
  }

  const Scene& scene_;
  plane::ProgramState state_;  // of those known to be inside
  plane::TernaryProgram
      program_;  // of all; those that are nowhere near are false
  std::vector<std::unique_ptr<PlacedLeaf>> leaves_;  // of instances
  std::vector<Box3> boxes_;                          // of instances
  // Of the search that goes on.
  const IsWanted* is_wanted_ = nullptr;
  const TakeFace* take_ = nullptr;
  std::vector<OpenFace>* open_ = nullptr;
  std::vector<std::uint32_t> around_;  // instances known to be inside
  std::uint32_t self_ = 0;             // the instance whose faces are judged
  // Of the face that is measured.
  plane::ProgramState outside_;  // as state_, for the side above the face
  ScanLines lines_;
  std::vector<LiveLeaf> live_;
  std::vector<Entry> entries_;
};

BoundaryFinder::BoundaryFinder(const Scene& scene)
    : search_(std::make_unique<Search>(scene)) {}

BoundaryFinder::~BoundaryFinder() = default;

std::vector<OpenFace> BoundaryFinder::take_settled(const IsWanted& is_wanted,
                                                   const TakeFace& take) {
  std::vector<OpenFace> open;
  search_->find(is_wanted, take, &open);
  return open;
}

void BoundaryFinder::solve(const OpenFace& face, const TakeFace& take) {
  search_->solve(face, take);
}

MeasuredFace BoundaryFinder::measure(const OpenFace& face,
                                     std::size_t most_lines) {
  return search_->measure(face, most_lines);
}

void visit_boundary_faces(const Scene& scene, const IsWanted& is_wanted,
                          const TakeFace& take) {
  BoundaryFinder::Search(scene).find(is_wanted, take, nullptr);
}

bool is_upright(const OpenFace& face) {
  return std::abs(face.normal.z) <= 1e-10;
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
