#include "ldni/scanline_sampler.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lamina::ldni {
namespace {

// A vertex in the world and the number of sections below it, which alone
// decides between which layers it lies.
struct Vertex {
  Vec3 position;
  std::uint32_t level;
};

// Where the edge from `lower` to `upper` meets height z. Callers order the
// ends by level, so both triangles of an edge get the same bits.
Vec2 point_on_edge(const Vec3& lower, const Vec3& upper, double z) {
  // A vertex on the section counts as below, so z may lie off the edge by
  // the distance that counts as on.
  const double t = std::clamp((z - lower.z) / (upper.z - lower.z), 0.0, 1.0);
  return {lower.x + t * (upper.x - lower.x), lower.y + t * (upper.y - lower.y)};
}

// The part of a triangle (counter-clockwise from outside) in layer `layer`,
// with the inside of the leaf on its left as seen from above: it begins on
// the edge that goes down through the section, ends on the one that goes up.
struct Segment {
  Vec2 begin;
  Vec2 end;
};
Segment cut_triangle(const std::array<const Vertex*, 3>& corners,
                     std::uint32_t layer, double z) {
  Segment segment;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& from = *corners[i];
    const Vertex& to = *corners[i == 2 ? 0 : i + 1];
    const bool from_above = from.level > layer;
    if (from_above == (to.level > layer)) continue;
    if (from_above) {
      segment.begin = point_on_edge(to.position, from.position, z);
    } else {
      segment.end = point_on_edge(from.position, to.position, z);
    }
  }
  return segment;
}

// Unit normal of a triangle. The sign of y is that of the crossing: where the
// face is almost parallel to the rays, rounding must not turn an entry into an
// exit.
glm::vec3 face_normal(const std::array<const Vertex*, 3>& corners,
                      bool is_entry) {
  const Vec3 a = corners[0]->position;
  const Vec3 cross =
      glm::cross(corners[1]->position - a, corners[2]->position - a);
  const double length = glm::length(cross);
  glm::vec3 normal(0);
  if (length > 0) normal = glm::vec3(cross / length);
  constexpr float kLeast = std::numeric_limits<float>::min();
  const float y = std::max(std::abs(normal.y), kLeast);
  normal.y = is_entry ? -y : y;
  return normal;
}

std::unique_ptr<const csg::Mesh> make_mesh(const csg::Leaf& leaf) {
  // Meshes of a leaf joined to one.
  auto mesh = std::make_unique<csg::Mesh>();
  for (const csg::Mesh& part : leaf.meshes) {
    const auto shift = static_cast<std::uint32_t>(mesh->vertices.size());
    mesh->vertices.insert(mesh->vertices.end(), part.vertices.begin(),
                          part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) {
      mesh->triangles.push_back({a + shift, b + shift, c + shift});
    }
  }
  return mesh;
}

}  // namespace

LeafMeshes::LeafMeshes(const csg::Scene& scene) {
  meshes_.reserve(scene.leaves.size());
  for (const csg::Leaf& leaf : scene.leaves) {
    if (leaf.sweeps.empty() && leaf.meshes.size() == 1) {
      meshes_.push_back(leaf.meshes.data());
      continue;
    }
    owned_.push_back(make_mesh(leaf));
    meshes_.push_back(owned_.back().get());
  }
}

struct ScanlineSampler::State {
  State(const csg::Scene& scene_in, const LeafMeshes& meshes_in,
        const RayGrid& rays_in, const LayerGrid& layers_in)
      : scene(scene_in), meshes(meshes_in), rays(rays_in), layers(layers_in) {}

  void place_vertices(const csg::Mesh& mesh, const Affine& world_from_leaf);
  void cross_triangle(const std::array<const Vertex*, 3>& corners);
  void cross_segment(const Segment& segment, std::uint32_t local_layer,
                     const std::array<const Vertex*, 3>& corners);
  void sort_by_pixel(LeafImages& out, std::size_t first_pixel);

  const csg::Scene& scene;
  const LeafMeshes& meshes;
  const RayGrid& rays;
  const LayerGrid& layers;

  // Of the leaf at hand.
  std::uint32_t instance = 0;
  GridBox box;
  std::vector<Vertex> vertices;
  std::vector<Sample> samples;        // in the order of the triangles
  std::vector<std::uint32_t> pixels;  // of the samples
};

ScanlineSampler::ScanlineSampler(const csg::Scene& scene,
                                 const LeafMeshes& meshes, const RayGrid& rays,
                                 const LayerGrid& layers)
    : state_(std::make_unique<State>(scene, meshes, rays, layers)) {}

ScanlineSampler::~ScanlineSampler() = default;

void ScanlineSampler::sample(std::uint32_t instance, const GridBox& box,
                             LeafImages& out) {
  State& state = *state_;
  const csg::Instance& placed = state.scene.instances[instance];
  const csg::Mesh& mesh = state.meshes[placed.leaf];
  state.instance = instance;
  state.box = box;
  state.samples.clear();
  state.pixels.clear();
  state.place_vertices(mesh, placed.world_from_leaf);

  // A mirror turns triangles inside out; turn them back.
  const bool is_mirrored =
      glm::determinant(glm::dmat3(placed.world_from_leaf)) < 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vertex* const first = &state.vertices[a];
    const Vertex* const second = &state.vertices[is_mirrored ? c : b];
    const Vertex* const third = &state.vertices[is_mirrored ? b : c];
    state.cross_triangle({first, second, third});
  }

  out.images.push_back({instance, box, out.ends.size()});
  state.sort_by_pixel(out, out.ends.size());
}

void ScanlineSampler::State::place_vertices(const csg::Mesh& mesh,
                                            const Affine& world_from_leaf) {
  vertices.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 position = world_from_leaf * Vec4(mesh.vertices[i], 1);
    vertices[i] = {position, layers.layers_below(position.z)};
  }
}

void ScanlineSampler::State::cross_triangle(
    const std::array<const Vertex*, 3>& corners) {
  const auto [low, high] =
      std::minmax({corners[0]->level, corners[1]->level, corners[2]->level});
  const std::uint32_t begin = std::max(low, box.layer_start);
  const std::uint32_t end = std::min(high, box.layer_end());
  for (std::uint32_t layer = begin; layer < end; ++layer) {
    cross_segment(cut_triangle(corners, layer, layers.section_z(layer)),
                  layer - box.layer_start, corners);
  }
}

void ScanlineSampler::State::cross_segment(
    const Segment& segment, std::uint32_t local_layer,
    const std::array<const Vertex*, 3>& corners) {
  const bool is_entry = segment.begin.x < segment.end.x;
  const Vec2 left = is_entry ? segment.begin : segment.end;
  const Vec2 right = is_entry ? segment.end : segment.begin;
  const std::uint32_t begin = std::max(rays.rays_below(left.x), box.ray_start);
  const std::uint32_t end = std::min(rays.rays_below(right.x), box.ray_end());
  if (begin >= end) return;

  const glm::vec3 normal = face_normal(corners, is_entry);
  const double slope = (right.y - left.y) / (right.x - left.x);
  const auto [low, high] = std::minmax(left.y, right.y);
  const std::size_t row = std::size_t{local_layer} * box.ray_count;
  for (std::uint32_t ray = begin; ray < end; ++ray) {
    const double y = left.y + (rays.ray_x(ray) - left.x) * slope;
    samples.push_back({std::clamp(y, low, high), normal, instance});
    pixels.push_back(static_cast<std::uint32_t>(row + ray - box.ray_start));
  }
}

// Counting sort of the samples at hand to the end of `out`.
void ScanlineSampler::State::sort_by_pixel(LeafImages& out,
                                           std::size_t first_pixel) {
  const std::size_t first_sample = out.samples.size();
  out.samples.resize(first_sample + samples.size());
  out.ends.resize(first_pixel + box.pixel_count(), 0);
  const std::span<std::uint32_t> ends(
      out.ends.begin() + static_cast<std::ptrdiff_t>(first_pixel),
      out.ends.end());
  for (const std::uint32_t pixel : pixels) ++ends[pixel];
  std::exclusive_scan(ends.begin(), ends.end(), ends.begin(),
                      static_cast<std::uint32_t>(first_sample));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    out.samples[ends[pixels[i]]++] = samples[i];
  }
}

}  // namespace lamina::ldni
