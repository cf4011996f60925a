#include "ldni/section/detail/csg_pruning.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "plane/predicates.h"

namespace lamina::ldni::detail {
namespace {

// Leaves count as apart only by more than this [mm]: ten ties.
constexpr double kMargin = 1e-5;

// Operators with more children are not looked into, and for one instance no
// more leaves and operators are asked: what is not known is open.
constexpr std::uint32_t kMostChildren = 32;
constexpr std::uint64_t kMostQuestions = 64;

constexpr std::uint32_t kNoInstance = 0xffffffff;

// Returns the radius of the circle about the origin within the outline, where
// that sees all of it, else 0; and that of the circle around it.
std::pair<double, double> radii_of(const std::vector<Vec2>& outline) {
  double inner = 1e300;
  double outer = 0;
  Vec2 from = outline.back();
  for (const Vec2& to : outline) {
    const double distance = cross(from, to) / glm::length(to - from);
    inner = distance > 0 ? std::min(inner, distance) : 0;
    outer = std::max(outer, glm::length(to));
    from = to;
  }
  return {inner, outer};
}

bool rises(const std::vector<Vec2>& profile) {
  return std::is_sorted(
      profile.begin(), profile.end(),
      [](const Vec2& a, const Vec2& b) { return a.y <= b.y; });
}

}  // namespace

// In coordinates of the leaf the section of a loft at a height is its outline
// times a scale, so it lies within outer · scale of the axis and holds all
// within inner · scale.
struct CsgPruning::Body {
  Body(const csg::Instance& instance, const csg::Leaf& leaf) {
    const glm::dmat3 linear(instance.world_from_leaf);
    if (leaf.lofts.size() != 1 || !leaf.meshes.empty() ||
        !(std::abs(glm::determinant(linear)) > 0)) {
      return;
    }
    loft = leaf.lofts.data();
    leaf_from_world = glm::inverse(linear);
    shift = instance.world_from_leaf[3];
    for (int axis = 0; axis < 3; ++axis) {
      reach[axis] = glm::abs(leaf_from_world[axis]);
    }
    std::tie(inner, outer) = radii_of(*loft->outline);
    if (loft->is_closed_profile || !rises(loft->profile)) inner = 0;
  }

  // Least and greatest scale of the profile between two heights, as if it went
  // on past its ends; greatest < least where it does not reach there.
  std::pair<double, double> scales_between(double low, double high) const {
    double least = 1e300;
    double greatest = -1e300;
    const std::vector<Vec2>& profile = loft->profile;
    Vec2 from = loft->is_closed_profile ? profile.back() : profile.front();
    for (const Vec2& to : profile) {
      const auto [below, above] = std::minmax(from.y, to.y);
      if (below <= high && above >= low) {
        for (const double height : {low, high}) {
          const double part =
              above > below
                  ? std::clamp((height - from.y) / (to.y - from.y), 0.0, 1.0)
                  : 0;
          const double scale = from.x + part * (to.x - from.x);
          least = std::min(least, scale);
          greatest = std::max(greatest, scale);
        }
        if (above == below) {
          least = std::min(least, to.x);
          greatest = std::max(greatest, to.x);
        }
      }
      from = to;
    }
    return {least, greatest};
  }

  const csg::Loft* loft = nullptr;  // null: only the box is known
  glm::dmat3 leaf_from_world{1.0};
  glm::dmat3 reach{1.0};  // its magnitudes
  Vec3 shift{0.0};
  double inner = 0;
  double outer = 0;
};

CsgPruning::CsgPruning(const csg::Scene& scene)
    : scene_(scene),
      program_(csg::program_of(scene), plane::Ternary::kUnknown) {
  list_children();
}

CsgPruning::~CsgPruning() = default;

void CsgPruning::list_children() {
  const auto node_count = static_cast<std::uint32_t>(scene_.program.size());
  const auto is_listed = [this](std::uint32_t node) {
    return scene_.program[node].child_count <= kMostChildren;
  };
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < node_count; ++i) {
    ends_.push_back(sum);  // the begin, until the children are there
    if (is_listed(i)) sum += scene_.program[i].child_count;
  }
  children_.resize(sum);
  const auto add = [&](std::uint32_t parent, Child child) {
    if (is_listed(parent)) children_[ends_[parent]++] = child;
  };
  for (std::uint32_t i = 1; i < node_count; ++i) {
    add(scene_.program[i].parent, {i, false});
  }
  for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
    add(scene_.instances[i].parent, {i, true});
  }
}

bool CsgPruning::matters(std::uint32_t instance) {
  Box3 box = scene_.instances[instance].box;
  box.low -= kMargin;
  box.high += kMargin;
  last_question_ = questions_ + kMostQuestions;
  const bool matters = !is_decided_above(instance, box);
  for (const std::uint32_t other : known_) {
    program_.set(other, plane::Ternary::kUnknown);
  }
  known_.clear();
  return matters;
}

// Goes from the instance to the root and asks the siblings of its branch,
// until an operator is decided.
bool CsgPruning::is_decided_above(std::uint32_t instance, const Box3& box) {
  Child branch{instance, true};
  std::uint32_t node = scene_.instances[instance].parent;
  for (;;) {
    ask(node, branch, box);
    if (program_.is_decided(node)) return true;
    if (node == 0 || questions_ == last_question_) return false;
    ++questions_;
    branch = {node, false};
    node = scene_.program[node].parent;
  }
}

// Asks the children of an operator, but for one of them, and theirs.
void CsgPruning::ask(std::uint32_t node, const Child& but, const Box3& box) {
  const std::uint32_t begin = node == 0 ? 0 : ends_[node - 1];
  for (std::uint32_t i = begin; i < ends_[node]; ++i) {
    const Child& child = children_[i];
    if (child == but) continue;
    if (questions_ == last_question_) return;
    ++questions_;
    if (child.is_instance) {
      const plane::Ternary value = value_of(child.number, box);
      if (value == plane::Ternary::kUnknown) continue;
      program_.set(child.number, value);
      known_.push_back(child.number);
    } else {
      ask(child.number, {kNoInstance, true}, box);
    }
  }
}

plane::Ternary CsgPruning::value_of(std::uint32_t number, const Box3& box) {
  const csg::Instance& instance = scene_.instances[number];
  for (int axis = 0; axis < 3; ++axis) {
    if (box.low[axis] > instance.box.high[axis] ||
        box.high[axis] < instance.box.low[axis]) {
      return plane::Ternary::kFalse;
    }
  }
  const csg::Leaf& leaf = scene_.leaves[instance.leaf];
  const Body& body = bodies_.try_emplace(number, instance, leaf).first->second;
  if (body.loft == nullptr) return plane::Ternary::kUnknown;

  // The box around the box, in coordinates of the leaf.
  const Vec3 middle =
      body.leaf_from_world * (0.5 * (box.low + box.high) - body.shift);
  const Vec3 half = body.reach * (0.5 * (box.high - box.low));
  const Vec2 place = glm::abs(Vec2(middle));
  const Vec2 half_width(half);
  const double nearest = glm::length(glm::max(place - half_width, 0.0));
  const double farthest = glm::length(place + half_width);
  const double low = middle.z - half.z;
  const double high = middle.z + half.z;
  const auto [least, greatest] = body.scales_between(low, high);
  if (greatest < least || nearest > body.outer * greatest)
    return plane::Ternary::kFalse;
  const std::vector<Vec2>& profile = body.loft->profile;
  if (farthest < body.inner * least && low > profile.front().y &&
      high < profile.back().y) {
    return plane::Ternary::kTrue;
  }
  return plane::Ternary::kUnknown;
}

}  // namespace lamina::ldni::detail
