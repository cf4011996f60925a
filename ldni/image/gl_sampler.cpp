// The sampler of Zeng et al. 2011: OpenGL draws each leaf as seen along the
// rays, one pixel for a ray in a layer, and what is drawn over a pixel's middle
// is what the ray meets.
//
// The paper draws each leaf by itself. Departure: as a fragment says which face
// it is of, leaves can share a picture, each in its place. A drawing and its
// way back cost a graphics processor some 80 µs, whatever is in it.
//
// OpenGL says which faces a ray meets (face_raster.h); where it meets them is
// computed here, in double precision, from the face's plane, and kept within
// the face's own depths. Corners are drawn up to 1/256 pixel from where they
// are (detail/face_projector.h). So a ray meets what the exact sampler meets,
// unless an edge passes it within 1/256 of pitch and thickness. There
//   - another face can be met, and so another number of samples;
//   - depths differ by no more than twice what the steepest of faces so near
//     rises over that distance.
//
// Every pixel of a closed leaf is drawn as often from the front as from the
// back. Where a driver that rasterises otherwise breaks this, the pixel is
// sampled exactly instead and counted.

#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "ldni/image/detail/face_projector.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {
namespace {

// What leaves that are drawn together have at most, unless one has more: some
// 30 MB.
constexpr std::size_t kGroupTriangles = 1 << 18;
constexpr std::size_t kGroupPixels = 1 << 21;

// Returns the smallest box around those of the leaves.
GridBox box_around(std::span<const LeafBox> leaves) {
  GridBox result = leaves[0].box;
  for (const auto& [instance, box] : leaves.subspan(1)) {
    const std::uint32_t ray_end = std::max(result.ray_end(), box.ray_end());
    const std::uint32_t layer_end =
        std::max(result.layer_end(), box.layer_end());
    result.ray_start = std::min(result.ray_start, box.ray_start);
    result.ray_count = ray_end - result.ray_start;
    result.layer_start = std::min(result.layer_start, box.layer_start);
    result.layer_count = layer_end - result.layer_start;
  }
  return result;
}

// Returns the two halves of `box`, cut across its longer side.
std::array<GridBox, 2> halves(const GridBox& box) {
  std::array<GridBox, 2> result = {box, box};
  if (box.ray_count >= box.layer_count) {
    result[0].ray_count = box.ray_count / 2;
    result[1].ray_start += result[0].ray_count;
    result[1].ray_count -= result[0].ray_count;
  } else {
    result[0].layer_count = box.layer_count / 2;
    result[1].layer_start += result[0].layer_count;
    result[1].layer_count -= result[0].layer_count;
  }
  return result;
}

// Returns the depth at which the ray at (x, z) meets the plane of a face,
// within the depths of the face. `normal` is any normal of it.
double depth_on(const std::array<Vec3, 3>& face, const Vec3& normal, double x,
                double z) {
  if (normal.y == 0) return face[0].y;
  const double y =
      face[0].y -
      (normal.x * (x - face[0].x) + normal.z * (z - face[0].z)) / normal.y;
  const auto [low, high] = std::minmax({face[0].y, face[1].y, face[2].y});
  return std::clamp(y, low, high);
}

bool is_balanced(std::span<const std::uint32_t> faces_and_sides) {
  const auto entries =
      std::count_if(faces_and_sides.begin(), faces_and_sides.end(),
                    [](std::uint32_t face) { return (face & 1) != 0; });
  return 2 * static_cast<std::size_t>(entries) == faces_and_sides.size();
}

class GlSampler final : public Sampler {
 public:
  GlSampler(const csg::Scene& scene, const RayGrid& rays,
            const LayerGrid& layers, std::unique_ptr<FaceRaster> raster)
      : scene_(scene),
        rays_(rays),
        layers_(layers),
        raster_(std::move(raster)),
        projector_(rays, layers),
        exact_sampler_(make_scanline_sampler(scene, rays, layers)) {}

  void sample(std::span<const LeafBox> leaves, LeafImages& out) override;

  std::uint64_t repaired_pixels() const override { return repaired_pixels_; }

 private:
  std::size_t place_group(std::span<const LeafBox> leaves);
  const csg::Mesh& mesh_of(std::uint32_t leaf);
  void forget_meshes();
  void sample_group(LeafImages& out);
  void draw(const GridBox& picture);
  bool try_draw(const GridBox& picture);
  void sort_by_pixel();
  void append_image(std::uint32_t leaf, LeafImages& out);
  void append_pixel(std::uint32_t leaf, std::uint32_t pixel,
                    std::span<std::uint32_t> found, LeafImages& out);
  Sample make_sample(std::uint32_t leaf, const Fragment& fragment) const;
  void repair_pixel(std::uint32_t leaf, std::uint32_t pixel, LeafImages& out);

  const csg::Scene& scene_;
  const RayGrid& rays_;
  const LayerGrid& layers_;
  std::unique_ptr<FaceRaster> raster_;
  FaceProjector projector_;
  std::uint64_t repaired_pixels_ = 0;

  // Made for leaves that have none, by leaf.
  std::map<std::uint32_t, csg::Mesh> meshes_;
  std::size_t made_triangles_ = 0;  // of them

  // The leaves that are drawn together. Their pixels are numbered through, leaf
  // by leaf.
  std::span<const LeafBox> group_;
  std::vector<std::uint32_t> first_pixels_;  // of each leaf, and the end
  std::vector<Fragment> fragments_;  // pixels of the group, faces of a leaf
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> faces_and_sides_;  // of the fragments, by pixel

  std::unique_ptr<Sampler> exact_sampler_;
  LeafImages exact_;  // a leaf's image, once a pixel was found wrong
};

void GlSampler::sample(std::span<const LeafBox> leaves, LeafImages& out) {
  while (!leaves.empty()) {
    const std::size_t count = place_group(leaves);
    group_ = leaves.first(count);
    sample_group(out);
    leaves = leaves.subspan(count);
  }
}

// Places as many of the leaves as are drawn together, one at least. Returns how
// many.
std::size_t GlSampler::place_group(std::span<const LeafBox> leaves) {
  projector_.clear();
  if (made_triangles_ > kGroupTriangles && meshes_.size() > 1) forget_meshes();
  first_pixels_ = {0};
  std::size_t triangles = 0;
  std::size_t pixels = 0;
  std::size_t count = 0;
  for (const auto& [instance, box] : leaves) {
    const csg::Instance& placed = scene_.instances[instance];
    const csg::Mesh& mesh = mesh_of(placed.leaf);
    triangles += mesh.triangles.size();
    pixels += box.pixel_count();
    if (count > 0 && (triangles > kGroupTriangles || pixels > kGroupPixels)) {
      break;
    }
    projector_.place(mesh, placed.world_from_leaf, box);
    first_pixels_.push_back(static_cast<std::uint32_t>(pixels));
    ++count;
  }
  return count;
}

const csg::Mesh& GlSampler::mesh_of(std::uint32_t index) {
  const csg::Leaf& wanted = scene_.leaves[index];
  if (wanted.lofts.empty() && wanted.meshes.size() == 1) {
    return wanted.meshes[0];
  }
  const auto [place, is_new] = meshes_.try_emplace(index);
  if (is_new) {
    place->second = csg::explicit_mesh(wanted);
    made_triangles_ += place->second.triangles.size();
  }
  return place->second;
}

void GlSampler::forget_meshes() {
  meshes_.clear();
  made_triangles_ = 0;
}

void GlSampler::sample_group(LeafImages& out) {
  fragments_.clear();
  draw(box_around(group_));
  sort_by_pixel();
  for (std::uint32_t leaf = 0; leaf < group_.size(); ++leaf) {
    append_image(leaf, out);
  }
}

// Draws `picture`, in parts where it is too large or too full.
void GlSampler::draw(const GridBox& picture) {
  if (try_draw(picture)) return;
  if (picture.pixel_count() == 1) throw std::bad_alloc();
  for (const GridBox& half : halves(picture)) draw(half);
}

bool GlSampler::try_draw(const GridBox& picture) {
  if (picture.ray_count > kPictureSize || picture.layer_count > kPictureSize) {
    return false;
  }
  projector_.project(picture);
  if (projector_.corners().empty()) return true;
  if (projector_.corners().size() > 3 * kPictureTriangles) return false;
  const std::size_t begin = fragments_.size();
  if (!raster_->draw(projector_.corners(), static_cast<int>(picture.ray_count),
                     static_cast<int>(picture.layer_count), fragments_)) {
    return false;
  }
  // From the picture's pixels and triangles to those of the leaves.
  std::size_t kept = begin;
  for (std::size_t i = begin; i < fragments_.size(); ++i) {
    const Fragment& fragment = fragments_[i];
    const auto& [leaf, triangle] = projector_.face_of(fragment.face());
    const GridBox& box = group_[leaf].box;
    const std::uint32_t layer =
        picture.layer_start + fragment.pixel / picture.ray_count;
    const std::uint32_t ray =
        picture.ray_start + fragment.pixel % picture.ray_count;
    if (!box.contains(layer, ray)) continue;  // in the picture for another leaf
    fragments_[kept++] = {first_pixels_[leaf] +
                              (layer - box.layer_start) * box.ray_count +
                              (ray - box.ray_start),
                          triangle << 1 | (fragment.is_entry() ? 1U : 0U)};
  }
  fragments_.resize(kept);
  return true;
}

// Counting sort.
void GlSampler::sort_by_pixel() {
  ends_.assign(first_pixels_.back(), 0);
  for (const Fragment& fragment : fragments_) ++ends_[fragment.pixel];
  std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0U);
  faces_and_sides_.resize(fragments_.size());
  for (const Fragment& fragment : fragments_) {
    faces_and_sides_[ends_[fragment.pixel]++] = fragment.face_and_side;
  }
}

void GlSampler::append_image(std::uint32_t leaf, LeafImages& out) {
  exact_.clear();
  out.images.push_back({group_[leaf], out.ends.size()});
  const std::uint32_t first = first_pixels_[leaf];
  std::uint32_t begin = first == 0 ? 0 : ends_[first - 1];
  for (std::uint32_t i = first; i < first_pixels_[leaf + 1]; ++i) {
    append_pixel(leaf, i - first,
                 std::span(faces_and_sides_).subspan(begin, ends_[i] - begin),
                 out);
    begin = ends_[i];
  }
}

// `pixel`: of the leaf's box. `found`: in any order, which depends on how
// OpenGL's threads went.
void GlSampler::append_pixel(std::uint32_t leaf, std::uint32_t pixel,
                             std::span<std::uint32_t> found, LeafImages& out) {
  if (is_balanced(found)) {
    std::sort(found.begin(), found.end());
    for (const std::uint32_t face_and_side : found) {
      out.samples.push_back(make_sample(leaf, {pixel, face_and_side}));
    }
  } else {
    repair_pixel(leaf, pixel, out);
  }
  out.ends.push_back(static_cast<std::uint32_t>(out.samples.size()));
}

Sample GlSampler::make_sample(std::uint32_t leaf,
                              const Fragment& fragment) const {
  const auto& [instance, box] = group_[leaf];
  const std::array<Vec3, 3> face =
      projector_.corners_of({leaf, fragment.face()});
  const Vec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
  const double x = rays_.ray_x(box.ray_start + fragment.pixel % box.ray_count);
  const double z =
      layers_.section_z(box.layer_start + fragment.pixel / box.ray_count);
  const double length = glm::length(normal);
  return {
      depth_on(face, normal, x, z),
      sample_normal(length > 0 ? normal / length : normal, fragment.is_entry()),
      instance};
}

void GlSampler::repair_pixel(std::uint32_t leaf, std::uint32_t pixel,
                             LeafImages& out) {
  if (exact_.images.empty()) {
    exact_sampler_->sample(group_.subspan(leaf, 1), exact_);
  }
  const GridBox& box = group_[leaf].box;
  const auto samples = exact_.ray(exact_.images[0], pixel / box.ray_count,
                                  pixel % box.ray_count);
  out.samples.insert(out.samples.end(), samples.begin(), samples.end());
  ++repaired_pixels_;
}

}  // namespace

std::unique_ptr<Sampler> make_gl_sampler(const csg::Scene& scene,
                                         const RayGrid& rays,
                                         const LayerGrid& layers,
                                         std::unique_ptr<FaceRaster> raster) {
  return std::make_unique<GlSampler>(scene, rays, layers, std::move(raster));
}

}  // namespace lamina::ldni
