#pragma once
// A solid as samples: points of its surface, and cells inside.
//
// The layered depth-normal image of the result (Zeng et al. 2011, sections 3
// and 4) has a point, a normal and a leaf wherever one of its rays enters or
// leaves the solid. Rays along one axis meet a surface parallel to them rarely;
// so the image is made three times, with rays along x, y and z, as in Wang,
// Leung and Chen, Solid modeling of polyhedral objects by layered depth-normal
// images on the GPU, CAD 2010. Each point is exact: it is where a ray meets a
// facet of the design.
//
// A facet with the normal n meets (|n.x| + |n.y| + |n.z|) / pitch² rays of the
// three images per unit of area, at least 1 / pitch². No place of a facet that
// is wider than a few pitches is farther than kCover pitches from a point.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::slicer {

struct SurfacePoint {
  Vec3 place = Vec3(0);
  Vec3 normal = Vec3(0);       // unit length, out of the solid
  double area = 0;             // of the surface that it stands for [mm²]
  std::uint32_t instance = 0;  // into csg::Scene::instances
};

// How far a place of the surface may be from the nearest point [pitches]. Where
// all three images meet a facet least, n = (1, 1, 1) / √3, each has its points
// on a lattice with a cell of √3 pitch²; points of one of them are no farther
// than √(1/2) pitch from a ray through any place, and √3 times that along the
// facet.
inline constexpr double kCover = 1.2248;

// Points that one task takes.
inline constexpr std::size_t kPointsPerTask = 1 << 12;

// The cells of a cubic lattice whose middles are inside a solid, in runs along
// y: one cell follows the other.
class SolidCells {
 public:
  // How many steps along x, y and z.
  struct Index {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
  };

  SolidCells() = default;
  // columns  along x: rays of a layer
  SolidCells(Vec3 origin, double pitch, std::uint32_t columns);

  // Adds the next ray, along y: first those of the lowest layer, ascending in
  // x. Intervals ascend.
  void add_ray(std::span<const Vec2> intervals);

  double pitch() const { return pitch_; }
  std::size_t size() const { return size_; }
  // The number of the cell; no value where its middle is not inside.
  std::optional<std::uint32_t> find(const Index& index) const;
  Vec3 middle_of(const Index& index) const {
    return origin_ + pitch_ * Vec3(index.x, index.y, index.z);
  }
  // The cell around a place, inside or not.
  Index index_at(Vec3 place) const;
  // The number of the cell around a place, or of the one with the nearest
  // middle where that is not inside; no value where none is within kFarSteps
  // steps along each axis.
  std::optional<std::uint32_t> find_near(Vec3 place) const;
  static constexpr std::int32_t kFarSteps = 3;
  // Calls visit(number, index) for all cells, by ascending number.
  template <typename Visit>
  void visit(const Visit& visit) const {
    for (std::size_t ray = 0; ray < ends_.size(); ++ray) {
      for (const Run& run : runs_of(ray)) {
        Index index = {static_cast<std::int32_t>(ray % columns_), run.first,
                       static_cast<std::int32_t>(ray / columns_)};
        for (std::uint32_t i = run.number; index.y < run.end; ++i, ++index.y) {
          visit(i, index);
        }
      }
    }
  }

 private:
  struct Run {
    std::int32_t first = 0;
    std::int32_t end = 0;
    std::uint32_t number = 0;  // of the first cell
  };
  std::span<const Run> runs_of(std::size_t ray) const {
    const std::size_t begin = ray == 0 ? 0 : ends_[ray - 1];
    return {runs_.data() + begin, ends_[ray] - begin};
  }

  Vec3 origin_ = Vec3(0);
  double pitch_ = 1;
  std::uint32_t columns_ = 1;
  std::size_t size_ = 0;
  std::vector<Run> runs_;
  std::vector<std::size_t> ends_;  // of each ray's runs
};

struct SolidSamples {
  double pitch = 0;  // of the rays [mm]
  std::vector<SurfacePoint> points;
  SolidCells cells;  // of the same pitch
};

// Deterministic, on all threads.
//
// pitch  > 0 [mm]
SolidSamples sample_solid(const csg::Scene& scene, double pitch);

}  // namespace lamina::slicer
