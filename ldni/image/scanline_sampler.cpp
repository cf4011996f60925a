#include "ldni/image/scanline_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lamina::ldni {
namespace {

// A corner of a face, in the world. Its level, the number of sections below it,
// alone decides between which layers it lies.
struct Corner {
  Vec3 position;
  std::uint32_t level;
};

// Where the edge from `lower` to `upper` meets height z. Never left or right of
// both ends, not even by rounding.
Vec2 point_on_edge(const Vec3& lower, const Vec3& upper, double z) {
  // A vertex on the section counts as below, so z may lie off the edge by the
  // distance that counts as on.
  const double t = std::clamp((z - lower.z) / (upper.z - lower.z), 0.0, 1.0);
  const double x = lower.x + t * (upper.x - lower.x);
  const auto [left, right] = std::minmax(lower.x, upper.x);
  return {std::clamp(x, left, right), lower.y + t * (upper.y - lower.y)};
}

// The part of a face in a layer. The inside of the leaf is on its left as seen
// from above: it begins on an edge that goes down through the section and ends
// on one that goes up.
struct Segment {
  Vec2 begin;
  Vec2 end;
};

// Unit normal of a planar polygon, counter-clockwise as seen from its tip.
Vec3 polygon_normal(std::span<const Corner> corners) {
  const Vec3 origin = corners[0].position;
  Vec3 sum(0);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += glm::cross(corners[i - 1].position - origin,
                      corners[i].position - origin);
  }
  const double length = glm::length(sum);
  return length > 0 ? sum / length : Vec3(0, 1, 0);
}

// Levels that vertices between two heights can have: [low, high].
struct LevelRange {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
};

}  // namespace

// The faces of one leaf instance on their way into samples.
struct ScanlineSampler::State {
  State(const csg::Scene& scene_in, const RayGrid& rays_in,
        const LayerGrid& layers_in)
      : scene(scene_in), rays(rays_in), layers(layers_in) {}

  void sample_loft(const csg::Loft& loft, bool is_inside_out);
  void place_loft(const csg::Loft& loft);
  void fill_ring(std::size_t ring, std::vector<std::uint32_t>& levels) const;
  void cross_strip(std::size_t low, std::size_t high, bool is_inside_out);
  void cross_cap(std::size_t ring, bool is_inside_out);
  Vec3 loft_vertex(std::size_t ring, std::size_t corner) const {
    return scales[ring] * outline[corner] + centres[ring];
  }

  void sample_mesh(const csg::Mesh& mesh, bool is_inside_out);

  void cross_face(std::span<const Corner> corners);
  void cross_layer(std::span<const Corner> corners, std::uint32_t layer);
  void cross_segment(const Segment& segment, std::uint32_t layer,
                     std::span<const Corner> corners);
  void sort_by_pixel(LeafImages& out);

  bool meets_box(LevelRange levels) const {
    return levels.low < box.layer_end() && levels.high > box.layer_start;
  }

  const csg::Scene& scene;
  const RayGrid& rays;
  const LayerGrid& layers;

  // The leaf at hand.
  std::uint32_t instance = 0;
  Affine world_from_leaf{1.0};
  GridBox box;
  std::vector<Sample> samples;        // in the order of the faces
  std::vector<std::uint32_t> pixels;  // of the samples

  // The loft at hand: vertex (i, j) = scale_i · outline_j + centre_i.
  std::vector<double> scales;
  std::vector<Vec3> centres;
  std::vector<Vec3> outline;
  std::vector<LevelRange> ring_levels;
  std::vector<std::uint32_t> low_levels;  // of the rings of a strip, by corner
  std::vector<std::uint32_t> high_levels;
  std::size_t filled_ring = 0;  // the ring of high_levels

  // The mesh at hand.
  std::vector<Corner> vertices;

  // The face at hand.
  bool has_normal = false;
  Vec3 normal{0};
  std::vector<Corner> cap;
  std::vector<Vec2> begins;
  std::vector<Vec2> ends;
};

ScanlineSampler::ScanlineSampler(const csg::Scene& scene, const RayGrid& rays,
                                 const LayerGrid& layers)
    : state_(std::make_unique<State>(scene, rays, layers)) {}

ScanlineSampler::~ScanlineSampler() = default;

void ScanlineSampler::sample(std::uint32_t instance, const GridBox& box,
                             LeafImages& out) {
  State& state = *state_;
  const csg::Instance& placed = state.scene.instances[instance];
  const csg::Leaf& leaf = state.scene.leaves[placed.leaf];
  state.instance = instance;
  state.world_from_leaf = placed.world_from_leaf;
  state.box = box;
  state.samples.clear();
  state.pixels.clear();

  // A mirror turns faces inside out.
  const bool is_mirrored =
      glm::determinant(glm::dmat3(placed.world_from_leaf)) < 0;
  for (const csg::Loft& loft : leaf.lofts) {
    state.sample_loft(loft, is_mirrored != loft.is_cavity);
  }
  for (const csg::Mesh& mesh : leaf.meshes) {
    state.sample_mesh(mesh, is_mirrored);
  }

  out.images.push_back({instance, box, out.ends.size()});
  state.sort_by_pixel(out);
}

// --- Lofts ------------------------------------------------------------------

void ScanlineSampler::State::sample_loft(const csg::Loft& loft,
                                         bool is_inside_out) {
  place_loft(loft);
  const std::size_t rings = loft.profile.size();
  for (std::size_t low = 0; low + 1 < rings; ++low) {
    cross_strip(low, low + 1, is_inside_out);
  }
  if (loft.is_closed_profile) {
    cross_strip(rings - 1, 0, is_inside_out);
  } else {
    cross_cap(0, !is_inside_out);
    cross_cap(rings - 1, is_inside_out);
  }
}

void ScanlineSampler::State::place_loft(const csg::Loft& loft) {
  filled_ring = loft.profile.size();
  outline.clear();
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const Vec2& point : *loft.outline) {
    outline.push_back(world_from_leaf * Vec4(point, 0, 0));
    lowest = std::min(lowest, outline.back().z);
    highest = std::max(highest, outline.back().z);
  }
  scales.clear();
  centres.clear();
  ring_levels.clear();
  for (const Vec2& ring : loft.profile) {
    scales.push_back(ring.x);
    centres.push_back(world_from_leaf * Vec4(0, 0, ring.y, 1));
    // Rounding keeps order, so these bound the levels of all vertices.
    ring_levels.push_back(
        {layers.layers_below(ring.x * lowest + centres.back().z),
         layers.layers_below(ring.x * highest + centres.back().z)});
  }
}

// Levels of a ring's vertices.
void ScanlineSampler::State::fill_ring(
    std::size_t ring, std::vector<std::uint32_t>& levels) const {
  const auto [low, high] = ring_levels[ring];
  levels.assign(outline.size(), low);
  if (low == high) return;
  for (std::size_t j = 0; j < outline.size(); ++j) {
    levels[j] =
        layers.layers_below(scales[ring] * outline[j].z + centres[ring].z);
  }
}

// Side quads between two rings.
void ScanlineSampler::State::cross_strip(std::size_t low, std::size_t high,
                                         bool is_inside_out) {
  const LevelRange a = ring_levels[low];
  const LevelRange b = ring_levels[high];
  const LevelRange all{std::min(a.low, b.low), std::max(a.high, b.high)};
  if (all.low == all.high || !meets_box(all)) return;
  if (filled_ring == low) {
    std::swap(low_levels, high_levels);
  } else {
    fill_ring(low, low_levels);
  }
  fill_ring(high, high_levels);
  filled_ring = high;
  std::size_t j = outline.size() - 1;
  for (std::size_t next = 0; next < outline.size(); j = next++) {
    const std::array<std::uint32_t, 4> levels = {
        low_levels[j], low_levels[next], high_levels[next], high_levels[j]};
    const auto [least, most] =
        std::minmax_element(levels.begin(), levels.end());
    if (*least == *most || !meets_box({*least, *most})) continue;
    std::array<Corner, 4> corners = {{{loft_vertex(low, j), levels[0]},
                                      {loft_vertex(low, next), levels[1]},
                                      {loft_vertex(high, next), levels[2]},
                                      {loft_vertex(high, j), levels[3]}}};
    if (is_inside_out) std::swap(corners[1], corners[3]);
    cross_face(corners);
  }
}

void ScanlineSampler::State::cross_cap(std::size_t ring, bool is_inside_out) {
  const LevelRange all = ring_levels[ring];
  if (all.low == all.high || !meets_box(all)) return;
  fill_ring(ring, low_levels);
  cap.clear();
  for (std::size_t j = 0; j < outline.size(); ++j) {
    cap.push_back({loft_vertex(ring, j), low_levels[j]});
  }
  if (is_inside_out) std::reverse(cap.begin(), cap.end());
  cross_face(cap);
}

// --- Meshes -----------------------------------------------------------------

void ScanlineSampler::State::sample_mesh(const csg::Mesh& mesh,
                                         bool is_inside_out) {
  vertices.clear();
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 position = world_from_leaf * Vec4(vertex, 1);
    vertices.push_back({position, layers.layers_below(position.z)});
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto [low, high] =
        std::minmax({vertices[a].level, vertices[b].level, vertices[c].level});
    if (low == high || !meets_box({low, high})) continue;
    std::array<Corner, 3> corners = {vertices[a], vertices[b], vertices[c]};
    if (is_inside_out) std::swap(corners[1], corners[2]);
    cross_face(corners);
  }
}

// --- Faces ------------------------------------------------------------------

// Samples a planar face whose corners run counter-clockwise from outside.
void ScanlineSampler::State::cross_face(std::span<const Corner> corners) {
  std::uint32_t low = corners[0].level;
  std::uint32_t high = low;
  double left = corners[0].position.x;
  double right = left;
  for (const Corner& corner : corners) {
    low = std::min(low, corner.level);
    high = std::max(high, corner.level);
    left = std::min(left, corner.position.x);
    right = std::max(right, corner.position.x);
  }
  // Most faces of a fine mesh pass between two rays.
  if (rays.rays_below(left) == rays.rays_below(right)) return;
  has_normal = false;
  const std::uint32_t end = std::min(high, box.layer_end());
  for (std::uint32_t layer = std::max(low, box.layer_start); layer < end;
       ++layer) {
    cross_layer(corners, layer);
  }
}

void ScanlineSampler::State::cross_layer(std::span<const Corner> corners,
                                         std::uint32_t layer) {
  const double z = layers.section_z(layer);
  begins.clear();
  ends.clear();
  const Corner* from = &corners.back();
  for (const Corner& to : corners) {
    const bool from_above = from->level > layer;
    if (from_above != (to.level > layer)) {
      if (from_above) {
        begins.push_back(point_on_edge(to.position, from->position, z));
      } else {
        ends.push_back(point_on_edge(from->position, to.position, z));
      }
    }
    from = &to;
  }
  if (begins.size() > 1) {
    // A face that is not convex: its segments follow one another on one line,
    // all in the direction from begin to end, so the k-th begin belongs to the
    // k-th end. By rounding they may mix up; the ends stay the same points.
    const Vec2 across = ends[0] - begins[0];
    const bool sorts_by_x = std::abs(across.x) >= std::abs(across.y);
    const auto comes_first = [sorts_by_x](const Vec2& a, const Vec2& b) {
      return sorts_by_x ? a.x < b.x : a.y < b.y;
    };
    std::sort(begins.begin(), begins.end(), comes_first);
    std::sort(ends.begin(), ends.end(), comes_first);
  }
  for (std::size_t i = 0; i < begins.size(); ++i) {
    cross_segment({begins[i], ends[i]}, layer, corners);
  }
}

void ScanlineSampler::State::cross_segment(const Segment& segment,
                                           std::uint32_t layer,
                                           std::span<const Corner> corners) {
  const bool is_entry = segment.begin.x < segment.end.x;
  const Vec2 left = is_entry ? segment.begin : segment.end;
  const Vec2 right = is_entry ? segment.end : segment.begin;
  const std::uint32_t begin = std::max(rays.rays_below(left.x), box.ray_start);
  const std::uint32_t end = std::min(rays.rays_below(right.x), box.ray_end());
  if (begin >= end) return;

  if (!has_normal) {
    normal = polygon_normal(corners);
    has_normal = true;
  }
  Sample sample{0, sample_normal(normal, is_entry), instance};
  const double slope = (right.y - left.y) / (right.x - left.x);
  const auto [low, high] = std::minmax(left.y, right.y);
  const std::size_t row =
      std::size_t{layer - box.layer_start} * box.ray_count - box.ray_start;
  for (std::uint32_t ray = begin; ray < end; ++ray) {
    const double y = left.y + (rays.ray_x(ray) - left.x) * slope;
    sample.depth = std::clamp(y, low, high);
    samples.push_back(sample);
    pixels.push_back(static_cast<std::uint32_t>(row + ray));
  }
}

// Counting sort of the samples at hand to the end of `out`.
void ScanlineSampler::State::sort_by_pixel(LeafImages& out) {
  const std::size_t first_sample = out.samples.size();
  const std::size_t first_pixel = out.ends.size();
  out.samples.resize(first_sample + samples.size());
  out.ends.resize(first_pixel + box.pixel_count(), 0);
  const std::span<std::uint32_t> ends_of_image =
      std::span(out.ends).subspan(first_pixel);
  for (const std::uint32_t pixel : pixels) ++ends_of_image[pixel];
  std::exclusive_scan(ends_of_image.begin(), ends_of_image.end(),
                      ends_of_image.begin(),
                      static_cast<std::uint32_t>(first_sample));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    out.samples[ends_of_image[pixels[i]]++] = samples[i];
  }
}

}  // namespace lamina::ldni
