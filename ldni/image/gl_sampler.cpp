// The sampler of Zeng et al. 2011: OpenGL draws each leaf as seen along the
// rays, one pixel for a ray in a layer, and what is drawn over a pixel's middle
// is what the ray meets.
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

// Meshes made of lofts are kept until they have so many triangles: some 30 MB.
constexpr std::size_t kKeptTriangles = 1 << 18;

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

  void sample(const LeafBox& leaf, LeafImages& out) override;

  std::uint64_t repaired_pixels() const override { return repaired_pixels_; }

 private:
  const csg::Mesh& mesh_of(std::uint32_t leaf);
  void draw(const GridBox& picture);
  bool try_draw(const GridBox& picture);
  void sort_by_pixel();
  void append_pixel(std::uint32_t pixel, std::span<std::uint32_t> found,
                    LeafImages& out);
  Sample make_sample(const Fragment& fragment) const;
  void repair_pixel(std::uint32_t pixel, LeafImages& out);

  const csg::Scene& scene_;
  const RayGrid& rays_;
  const LayerGrid& layers_;
  std::unique_ptr<FaceRaster> raster_;
  FaceProjector projector_;
  std::uint64_t repaired_pixels_ = 0;

  // Made for leaves that have none, by leaf.
  std::map<std::uint32_t, csg::Mesh> meshes_;
  std::size_t made_triangles_ = 0;  // of them

  LeafBox leaf_;                     // that is sampled
  std::vector<Fragment> fragments_;  // pixels of its box, faces of its mesh
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> faces_and_sides_;  // of the fragments, by pixel

  std::unique_ptr<Sampler> exact_sampler_;
  LeafImages exact_;  // a leaf's image, once a pixel was found wrong
};

void GlSampler::sample(const LeafBox& leaf, LeafImages& out) {
  leaf_ = leaf;
  const csg::Instance& placed = scene_.instances[leaf.instance];
  projector_.place(mesh_of(placed.leaf), placed.world_from_leaf);
  fragments_.clear();
  draw(leaf.box);
  sort_by_pixel();
  exact_.clear();
  out.images.push_back({leaf, out.ends.size()});
  std::uint32_t begin = 0;
  for (std::uint32_t pixel = 0; pixel < ends_.size(); ++pixel) {
    const std::uint32_t end = ends_[pixel];
    append_pixel(pixel, std::span(faces_and_sides_).subspan(begin, end - begin),
                 out);
    begin = end;
  }
}

const csg::Mesh& GlSampler::mesh_of(std::uint32_t index) {
  const csg::Leaf& wanted = scene_.leaves[index];
  if (wanted.lofts.empty() && wanted.meshes.size() == 1) {
    return wanted.meshes[0];
  }
  const auto known = meshes_.find(index);
  if (known != meshes_.end()) return known->second;
  if (made_triangles_ > kKeptTriangles) {
    meshes_.clear();
    made_triangles_ = 0;
  }
  const csg::Mesh& made = meshes_[index] = csg::explicit_mesh(wanted);
  made_triangles_ += made.triangles.size();
  return made;
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
  // From the picture's pixels and triangles to those of the leaf.
  const GridBox& box = leaf_.box;
  for (std::size_t i = begin; i < fragments_.size(); ++i) {
    Fragment& fragment = fragments_[i];
    const std::uint32_t layer =
        picture.layer_start + fragment.pixel / picture.ray_count;
    const std::uint32_t ray =
        picture.ray_start + fragment.pixel % picture.ray_count;
    fragment = {
        (layer - box.layer_start) * box.ray_count + (ray - box.ray_start),
        projector_.face_of(fragment.face()) << 1 |
            (fragment.is_entry() ? 1U : 0U)};
  }
  return true;
}

// Counting sort.
void GlSampler::sort_by_pixel() {
  ends_.assign(leaf_.box.pixel_count(), 0);
  for (const Fragment& fragment : fragments_) ++ends_[fragment.pixel];
  std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0U);
  faces_and_sides_.resize(fragments_.size());
  for (const Fragment& fragment : fragments_) {
    faces_and_sides_[ends_[fragment.pixel]++] = fragment.face_and_side;
  }
}

// `found`: in any order, as the peels of the parts of a picture come.
void GlSampler::append_pixel(std::uint32_t pixel,
                             std::span<std::uint32_t> found, LeafImages& out) {
  if (is_balanced(found)) {
    std::sort(found.begin(), found.end());
    for (const std::uint32_t face_and_side : found) {
      out.samples.push_back(make_sample({pixel, face_and_side}));
    }
  } else {
    repair_pixel(pixel, out);
  }
  out.ends.push_back(static_cast<std::uint32_t>(out.samples.size()));
}

Sample GlSampler::make_sample(const Fragment& fragment) const {
  const GridBox& box = leaf_.box;
  const std::array<Vec3, 3> face = projector_.corners_of(fragment.face());
  const Vec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
  const double x = rays_.ray_x(box.ray_start + fragment.pixel % box.ray_count);
  const double z =
      layers_.section_z(box.layer_start + fragment.pixel / box.ray_count);
  const double length = glm::length(normal);
  return {
      depth_on(face, normal, x, z),
      sample_normal(length > 0 ? normal / length : normal, fragment.is_entry()),
      leaf_.instance};
}

void GlSampler::repair_pixel(std::uint32_t pixel, LeafImages& out) {
  if (exact_.images.empty()) exact_sampler_->sample(leaf_, exact_);
  const std::uint32_t ray_count = leaf_.box.ray_count;
  const auto samples =
      exact_.ray(exact_.images[0], pixel / ray_count, pixel % ray_count);
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
