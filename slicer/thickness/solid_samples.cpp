#include "slicer/thickness/solid_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "csg/boundary/move_scene.h"
#include "ldni/image/paper_slicer.h"
#include "ldni/section/grid.h"

namespace lamina::slicer {
namespace {

// Into how many blocks layers are parted at least, so that all threads work.
constexpr std::uint32_t kLeastBlocks = 16;

// Maps the axis to y, and keeps hands as they are: rays run along y.
Affine turn_to_y(int axis) {
  Affine turn(0.0);
  for (int i = 0; i < 3; ++i) turn[(axis + i) % 3][(1 + i) % 3] = 1;
  return turn;
}

// What one block of layers gave.
struct Block {
  std::vector<SurfacePoint> points;
  // Of all rays of its layers: where they are inside, and where each ends.
  std::vector<Vec2> intervals;
  std::vector<std::size_t> ends;
};

// Samples a scene along y. The points come turned back.
class RayCaster {
 public:
  RayCaster(const csg::Scene& scene, double pitch, int axis)
      : scene_(turned(scene, axis)),
        back_(csg::inverse_of(turn_to_y(axis))),
        layers_(ldni::LayerGrid::uniform(scene_.box.low.z, scene_.box.high.z,
                                         pitch)),
        plan_(ldni::make_paper_plan(scene_, layers_, pitch, {})) {}

  std::vector<Block> cast() const {
    const std::uint32_t count = layers_.layer_count();
    const std::uint32_t per_block =
        std::clamp(count / kLeastBlocks, 1U, plan_.layers_per_block);
    std::vector<Block> blocks((count + per_block - 1) / per_block);
    for_each_index(blocks.size(), [&](std::size_t i) {
      const auto first = static_cast<std::uint32_t>(i) * per_block;
      blocks[i] = cast_block(first, std::min(per_block, count - first));
    });
    return blocks;
  }

  // Of the first ray of the first layer, at the same share of y.
  Vec3 origin() const {
    return {plan_.rays.ray_x(0), scene_.box.low.y + plan_.rays.pitch() / 2,
            layers_.section_z(0)};
  }
  std::uint32_t columns() const { return plan_.rays.ray_count(); }

 private:
  static csg::Scene turned(csg::Scene scene, int axis) {
    csg::move_scene(scene, turn_to_y(axis), Vec3(0));
    return scene;
  }

  Block cast_block(std::uint32_t first, std::uint32_t count) const {
    Block block;
    ldni::PaperSlicer slicer(plan_);
    slicer.sample_block(first, count);
    for (std::uint32_t layer = first; layer < first + count; ++layer) {
      const ldni::LayerIntervals& image = slicer.intervals_of(layer);
      for (std::uint32_t ray = 0; ray < image.ray_count(); ++ray) {
        for (const ldni::Interval& interval : image.ray(ray)) {
          for (const ldni::Sample& end : {interval.enter, interval.exit}) {
            block.points.push_back(point_of(end, ray, layer));
          }
          block.intervals.emplace_back(interval.enter.depth,
                                       interval.exit.depth);
        }
        block.ends.push_back(block.intervals.size());
      }
    }
    return block;
  }

  SurfacePoint point_of(const ldni::Sample& sample, std::uint32_t ray,
                        std::uint32_t layer) const {
    const Vec3 normal(sample.normal);
    const double pitch = plan_.rays.pitch();
    const Vec3 steep = glm::abs(normal);
    return {back_ * Vec4(plan_.rays.ray_x(ray), sample.depth,
                         layers_.section_z(layer), 1),
            back_ * Vec4(normal, 0),
            pitch * pitch / (steep.x + steep.y + steep.z), sample.instance};
  }

  csg::Scene scene_;
  Affine back_;
  ldni::LayerGrid layers_;
  ldni::PaperPlan plan_;
};

}  // namespace

SolidCells::SolidCells(Vec3 origin, double pitch, std::uint32_t columns)
    : origin_(origin), pitch_(pitch), columns_(columns) {}

void SolidCells::add_ray(std::span<const Vec2> intervals) {
  for (const Vec2& interval : intervals) {
    const Vec2 steps = glm::ceil((interval - origin_.y) / pitch_);
    const Run run = {static_cast<std::int32_t>(steps.x),
                     static_cast<std::int32_t>(steps.y),
                     static_cast<std::uint32_t>(size_)};
    if (run.first >= run.end) continue;
    runs_.push_back(run);
    size_ += static_cast<std::size_t>(run.end - run.first);
  }
  ends_.push_back(runs_.size());
}

std::optional<std::uint32_t> SolidCells::find(const Index& index) const {
  if (index.x < 0 || index.z < 0 ||
      index.x >= static_cast<std::int32_t>(columns_)) {
    return std::nullopt;
  }
  const std::size_t ray = static_cast<std::size_t>(index.z) * columns_ +
                          static_cast<std::size_t>(index.x);
  if (ray >= ends_.size()) return std::nullopt;
  for (const Run& run : runs_of(ray)) {
    if (index.y < run.first) break;
    if (index.y < run.end) {
      return run.number + static_cast<std::uint32_t>(index.y - run.first);
    }
  }
  return std::nullopt;
}

SolidCells::Index SolidCells::index_at(Vec3 place) const {
  const Vec3 steps = glm::round((place - origin_) / pitch_);
  return {static_cast<std::int32_t>(steps.x),
          static_cast<std::int32_t>(steps.y),
          static_cast<std::int32_t>(steps.z)};
}

std::optional<std::uint32_t> SolidCells::find_near(Vec3 place) const {
  const Index around = index_at(place);
  std::optional<std::uint32_t> nearest = find(around);
  // What is nearest in a cube may be farther than what is beside the cube, by
  // less than a step.
  for (std::int32_t reach = 1; !nearest && reach <= kFarSteps; ++reach) {
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t z = around.z - reach; z <= around.z + reach; ++z) {
      for (std::int32_t x = around.x - reach; x <= around.x + reach; ++x) {
        for (std::int32_t y = around.y - reach; y <= around.y + reach; ++y) {
          const auto cell = find({x, y, z});
          if (!cell) continue;
          const double distance = glm::length(middle_of({x, y, z}) - place);
          if (distance >= least) continue;
          least = distance;
          nearest = cell;
        }
      }
    }
  }
  return nearest;
}

SolidSamples sample_solid(const csg::Scene& scene, double pitch) {
  SolidSamples samples = {pitch, {}, {}};
  if (scene.box.is_empty()) return samples;
  // Rays along y come last and are not turned: they make the cells.
  for (const int axis : {0, 2, 1}) {
    const RayCaster caster(scene, pitch, axis);
    const std::vector<Block> blocks = caster.cast();
    for (const Block& block : blocks) {
      samples.points.insert(samples.points.end(), block.points.begin(),
                            block.points.end());
    }
    if (axis != 1) continue;
    samples.cells = SolidCells(caster.origin(), pitch, caster.columns());
    for (const Block& block : blocks) {
      std::size_t begin = 0;
      for (const std::size_t end : block.ends) {
        samples.cells.add_ray({block.intervals.data() + begin, end - begin});
        begin = end;
      }
    }
  }
  return samples;
}

}  // namespace lamina::slicer
