#include "ldni/image/gl_sampler.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "ldni/image/detail/face_projector.h"
#include "ldni/image/scanline_sampler.h"

namespace lamina::ldni {
namespace {

constexpr std::uint32_t kNoLeaf = std::numeric_limits<std::uint32_t>::max();

// `box` in two halves, across its longer side.
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

// Where the ray at (x, z) meets the plane of a face, as far as the face
// reaches. `normal` is any normal of it.
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

}  // namespace

struct GlSampler::State {
  State(const csg::Scene& scene_in, const RayGrid& rays_in,
        const LayerGrid& layers_in, std::unique_ptr<FaceRaster> raster_in)
      : scene(scene_in),
        rays(rays_in),
        layers(layers_in),
        raster(std::move(raster_in)),
        projector(rays_in, layers_in),
        exact_sampler(scene_in, rays_in, layers_in) {}

  const csg::Mesh& mesh_of(std::uint32_t leaf);
  void draw(const GridBox& picture);
  bool try_draw(const GridBox& picture);
  void sort_by_pixel();
  void append_pixel(std::uint32_t pixel, std::span<std::uint32_t> found,
                    LeafImages& out);
  Sample make_sample(const Fragment& fragment) const;
  void repair_pixel(std::uint32_t pixel, LeafImages& out);

  const csg::Scene& scene;
  const RayGrid& rays;
  const LayerGrid& layers;
  std::unique_ptr<FaceRaster> raster;
  FaceProjector projector;
  std::uint64_t repaired_pixels = 0;

  // The last leaf, where it has no mesh of its own.
  std::uint32_t leaf = kNoLeaf;
  csg::Mesh mesh;

  // The image at hand.
  std::uint32_t instance = 0;
  GridBox box;
  std::vector<Fragment> fragments;  // pixels of the box, faces of the mesh
  std::vector<std::uint32_t> ends;
  std::vector<std::uint32_t> faces_and_sides;  // of the fragments, by pixel

  ScanlineSampler exact_sampler;
  LeafImages exact;  // the same image, once a pixel was found wrong
};

GlSampler::GlSampler(const csg::Scene& scene, const RayGrid& rays,
                     const LayerGrid& layers,
                     std::unique_ptr<FaceRaster> raster)
    : state_(std::make_unique<State>(scene, rays, layers, std::move(raster))) {}

GlSampler::~GlSampler() = default;

std::uint64_t GlSampler::repaired_pixels() const {
  return state_->repaired_pixels;
}

void GlSampler::sample(std::uint32_t instance, const GridBox& box,
                       LeafImages& out) {
  State& state = *state_;
  const csg::Instance& placed = state.scene.instances[instance];
  state.instance = instance;
  state.box = box;
  state.fragments.clear();
  state.exact.clear();
  state.projector.place(state.mesh_of(placed.leaf), placed.world_from_leaf);
  state.draw(box);
  state.sort_by_pixel();

  out.images.push_back({instance, box, out.ends.size()});
  std::uint32_t begin = 0;
  for (std::uint32_t pixel = 0; pixel < state.ends.size(); ++pixel) {
    const std::uint32_t end = state.ends[pixel];
    state.append_pixel(
        pixel, std::span(state.faces_and_sides).subspan(begin, end - begin),
        out);
    begin = end;
  }
}

const csg::Mesh& GlSampler::State::mesh_of(std::uint32_t index) {
  const csg::Leaf& wanted = scene.leaves[index];
  if (wanted.lofts.empty() && wanted.meshes.size() == 1) {
    return wanted.meshes[0];
  }
  if (leaf != index) mesh = csg::explicit_mesh(wanted);
  leaf = index;
  return mesh;
}

// Draws `picture`, in parts where it is too large or too full.
void GlSampler::State::draw(const GridBox& picture) {
  if (try_draw(picture)) return;
  if (picture.pixel_count() == 1) throw std::bad_alloc();
  for (const GridBox& half : halves(picture)) draw(half);
}

bool GlSampler::State::try_draw(const GridBox& picture) {
  if (picture.ray_count > kPictureSize || picture.layer_count > kPictureSize) {
    return false;
  }
  projector.project(picture);
  if (projector.corners().empty()) return true;
  if (projector.corners().size() > 3 * kPictureTriangles) return false;
  const std::size_t begin = fragments.size();
  if (!raster->draw(projector.corners(), static_cast<int>(picture.ray_count),
                    static_cast<int>(picture.layer_count), fragments)) {
    return false;
  }
  // From the picture's pixels and triangles to those of box and mesh.
  for (Fragment& fragment : std::span(fragments).subspan(begin)) {
    const std::uint32_t row = fragment.pixel / picture.ray_count +
                              picture.layer_start - box.layer_start;
    const std::uint32_t column =
        fragment.pixel % picture.ray_count + picture.ray_start - box.ray_start;
    fragment.pixel = row * box.ray_count + column;
    fragment.face_and_side = projector.face_of(fragment.face()) << 1 |
                             (fragment.is_entry() ? 1U : 0U);
  }
  return true;
}

// Counting sort.
void GlSampler::State::sort_by_pixel() {
  ends.assign(box.pixel_count(), 0);
  for (const Fragment& fragment : fragments) ++ends[fragment.pixel];
  std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0U);
  faces_and_sides.resize(fragments.size());
  for (const Fragment& fragment : fragments) {
    faces_and_sides[ends[fragment.pixel]++] = fragment.face_and_side;
  }
}

// `found`: in any order, which depends on how OpenGL's threads went.
void GlSampler::State::append_pixel(std::uint32_t pixel,
                                    std::span<std::uint32_t> found,
                                    LeafImages& out) {
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

Sample GlSampler::State::make_sample(const Fragment& fragment) const {
  const std::array<Vec3, 3> face = projector.corners_of(fragment.face());
  const Vec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
  const double x = rays.ray_x(box.ray_start + fragment.pixel % box.ray_count);
  const double z =
      layers.section_z(box.layer_start + fragment.pixel / box.ray_count);
  const double length = glm::length(normal);
  return {
      depth_on(face, normal, x, z),
      sample_normal(length > 0 ? normal / length : normal, fragment.is_entry()),
      instance};
}

void GlSampler::State::repair_pixel(std::uint32_t pixel, LeafImages& out) {
  if (exact.images.empty()) exact_sampler.sample(instance, box, exact);
  const auto samples =
      exact.rays(exact.images[0], pixel / box.ray_count, pixel % box.ray_count);
  out.samples.insert(out.samples.end(), samples.begin(), samples.end());
  ++repaired_pixels;
}

}  // namespace lamina::ldni
