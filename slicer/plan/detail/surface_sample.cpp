#include "slicer/plan/detail/surface_sample.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/boundary_faces.h"

namespace lamina::slicer {
namespace {

using csg::BoundaryFace;
using csg::OpenFace;

// With more lines than this, the area of a face costs too much to be exact.
constexpr std::size_t kMostLines = 512;

// How far an estimate by lines may be off, as a share of the face: its standard
// deviation is rather less.
constexpr double kRoughness = 0.005;

// The area of a plane polygon with holes [mm²].
double area_of(const BoundaryFace& face) {
  Vec3 twice(0);
  for (const auto& contour : face.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec3& next = contour[(i + 1) % contour.size()];
      // From the face's own corner, not from the origin: less is cancelled.
      twice += glm::cross(contour[i] - face.contours[0][0],
                          next - face.contours[0][0]);
    }
  }
  return glm::dot(twice, face.normal) / 2;
}

// Returns the area that each face of a sample of `count` stands for: a face
// that has it, or more, stands for itself alone. 0 where that holds for all.
double area_of_draw(const std::vector<OpenFace>& open, std::size_t count) {
  if (open.size() <= count) return 0;
  std::vector<double> areas;
  areas.reserve(open.size());
  for (const OpenFace& face : open) areas.push_back(face.area);
  std::ranges::sort(areas, std::greater<>());
  double rest = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::size_t large = 0;
  while (large < count &&
         areas[large] * static_cast<double>(count - large) >= rest) {
    rest -= areas[large++];
  }
  if (large == count) return areas[large];
  return rest / static_cast<double>(count - large);
}

class Sampler {
 public:
  explicit Sampler(const csg::Scene& scene) : scene_(scene), finder_(scene) {}

  SurfaceSample sample(std::size_t most_edges) {
    open_ = finder_.take_settled([](const Box3&) { return true; },
                                 [&](const BoundaryFace& face) {
                                   const Box3 box = csg::box_of(face);
                                   add({face.normal, area_of(face), box}, 1);
                                   sample_.box.add(box);
                                 });
    measured_.resize(open_.size());
    is_taken_.assign(open_.size(), false);
    const double draw = area_of_draw(open_, affordable_faces(most_edges));
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i].area >= draw) solve(i, 1);
    }
    for (int axis = 0; axis < 3; ++axis) {
      solve_reaching(axis, -1);
      solve_reaching(axis, 1);
    }
    if (draw > 0) solve_drawn(draw);
    sample_.doubt = 2 * std::sqrt(variance_);
    return std::move(sample_);
  }

 private:
  void add(const csg::BoundaryPart& part, double weight) {
    sample_.parts.push_back({part.normal, weight * part.area, part.box});
    sample_.area += weight * part.area;
  }

  const csg::MeasuredFace& measure(std::size_t open) {
    if (!measured_[open]) {
      measured_[open] = finder_.measure(open_[open], kMostLines);
    }
    return *measured_[open];
  }

  // Returns how many faces cost so many edges, by a few from everywhere.
  std::size_t affordable_faces(std::size_t most_edges) {
    constexpr std::size_t kTried = 64;
    constexpr std::size_t kLeast = 256;
    if (open_.size() <= kLeast) return kLeast;
    std::size_t edges = kTried;  // also what a face costs that has none
    for (std::size_t i = 0; i < kTried; ++i) {
      edges += measure(i * open_.size() / kTried).edges;
    }
    return std::max(kLeast, most_edges * kTried / edges);
  }

  // Returns the area of boundary that the face has.
  double solve(std::size_t open, double weight) {
    is_taken_[open] = true;
    double area = 0;
    const csg::MeasuredFace& measured = measure(open);
    if (!measured.is_exact) {
      const double rough = kRoughness * weight * open_[open].area;
      variance_ += rough * rough;
    }
    for (const csg::BoundaryPart& part : measured.parts) {
      area += part.area;
      add(part, weight);
      if (measured.is_exact) sample_.box.add(part.box);
    }
    return area;
  }

  // Looks at what may reach beyond all that is known, the outermost first.
  // Estimates do not say how far.
  void solve_reaching(int axis, double sign) {
    const auto reach_of = [&](const Box3& box) {
      return sign > 0 ? box.high[axis] : -box.low[axis];
    };
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      // Leaves reach beyond the scene's box, the surface does not.
      const double reach =
          std::min(reach_of(open_[i].box), reach_of(scene_.box));
      const bool is_known = is_taken_[i] && measured_[i]->is_exact;
      if (!is_known && reach > reach_of(sample_.box) + kSameLength) {
        order.emplace_back(-reach, i);
      }
    }
    std::ranges::sort(order);
    for (const auto& [reach, i] : order) {
      if (-reach <= reach_of(sample_.box) + kSameLength) break;
      if (!is_taken_[i]) solve(i, 1);
      if (measured_[i]->is_exact) continue;
      finder_.solve(open_[i], [&](const BoundaryFace& face) {
        sample_.box.add(csg::box_of(face));
      });
    }
  }

  // Lays the faces that are left one behind the other, and solves those that
  // lie at the middle of each `draw` of their area.
  void solve_drawn(double draw) {
    double passed = 0;
    double next = draw / 2;
    std::vector<double> shares;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (is_taken_[i]) continue;
      passed += open_[i].area;
      if (passed < next) continue;
      next += draw;
      shares.push_back(solve(i, draw / open_[i].area) / open_[i].area);
    }
    variance_ += variance_of(shares, draw);
  }

  // Of the area that they stand for.
  static double variance_of(const std::vector<double>& shares, double draw) {
    if (shares.empty()) return 0;
    const double mean = std::accumulate(shares.begin(), shares.end(), 0.0) /
                        static_cast<double>(shares.size());
    double sum = 0;
    for (const double share : shares) sum += (share - mean) * (share - mean);
    return draw * draw * sum;
  }

  const csg::Scene& scene_;
  csg::BoundaryFinder finder_;
  std::vector<OpenFace> open_;
  std::vector<std::optional<csg::MeasuredFace>> measured_;
  std::vector<bool> is_taken_;
  SurfaceSample sample_;
  double variance_ = 0;  // of the area [mm⁴]
};

}  // namespace

SurfaceSample sample_surface(const csg::Scene& scene, std::size_t most_edges) {
  return Sampler(scene).sample(most_edges);
}

}  // namespace lamina::slicer
