// The exact sampler, the reference for all others: it intersects faces with
// layers, and the segments that arise with rays, in double precision.
//
// A face is a triangle of a mesh, or of a loft a whole side quad or cap: they
// are planar, which saves half the segments, and no triangle of a primitive is
// ever stored.
//
// Watertight by three rules. A vertex is above a section or not by
// LayerGrid::layers_below alone. Where an edge crosses a section is computed
// from its lower to its upper end, so that both faces beside it get the same
// bits. And RayGrid::rays_below of these points decides which rays a segment
// meets. So the segments of a layer form closed loops, every ray enters a leaf
// as often as it leaves it, and rounding can only move a sample.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ldni/image/sampler.h"

namespace lamina::ldni {
namespace {

// A corner of a face, in the world. Its level is the number of sections below
// it, which alone decides between which layers it lies.
struct Corner {
  Vec3 position;
  std::uint32_t level;
};

// Returns where the edge from `lower` to `upper` meets height z: never left or
// right of both ends, not even by rounding.
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

// Returns the unit normal of a planar polygon, which runs counter-clockwise as
// seen from its tip.
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

class ScanlineSampler final : public Sampler {
 public:
  ScanlineSampler(const csg::Scene& scene, const RayGrid& rays,
                  const LayerGrid& layers)
      : scene_(scene), rays_(rays), layers_(layers) {}

  void sample(const LeafBox& leaf_box, LeafImages& out) override;

 private:
  void sample_loft(const csg::Loft& loft, bool is_inside_out);
  void place_loft(const csg::Loft& loft);
  void fill_ring(std::size_t ring, std::vector<std::uint32_t>& levels) const;
  void cross_strip(std::size_t low, std::size_t high, bool is_inside_out);
  void cross_cap(std::size_t ring, bool is_inside_out);
  Vec3 loft_vertex(std::size_t ring, std::size_t corner) const {
    return scales_[ring] * outline_[corner] + centres_[ring];
  }

  void sample_mesh(const csg::Mesh& mesh, bool is_inside_out);

  void cross_face(std::span<const Corner> corners);
  void cross_layer(std::span<const Corner> corners, std::uint32_t layer);
  void cross_segment(const Segment& segment, std::uint32_t layer,
                     std::span<const Corner> corners);
  void sort_by_pixel(LeafImages& out);

  bool meets_box(LevelRange levels) const {
    return levels.low < box_.layer_end() && levels.high > box_.layer_start;
  }

  const csg::Scene& scene_;
  const RayGrid& rays_;
  const LayerGrid& layers_;

  // The leaf that is sampled.
  std::uint32_t instance_ = 0;
  Affine world_from_leaf_{1.0};
  GridBox box_;
  std::vector<Sample> samples_;        // in the order of the faces
  std::vector<std::uint32_t> pixels_;  // of the samples

  // Its loft: vertex (i, j) = scale_i · outline_j + centre_i.
  std::vector<double> scales_;
  std::vector<Vec3> centres_;
  std::vector<Vec3> outline_;
  std::vector<LevelRange> ring_levels_;
  std::vector<std::uint32_t> low_levels_;  // of the rings of a strip, by corner
  std::vector<std::uint32_t> high_levels_;
  std::size_t filled_ring_ = 0;  // the ring of high_levels_

  // Its mesh.
  std::vector<Corner> vertices_;

  // Its face.
  bool has_normal_ = false;
  Vec3 normal_{0};
  std::vector<Corner> cap_;
  std::vector<Vec2> begins_;
  std::vector<Vec2> ends_;
};

void ScanlineSampler::sample(const LeafBox& leaf_box, LeafImages& out) {
  const csg::Instance& placed = scene_.instances[leaf_box.instance];
  const csg::Leaf& leaf = scene_.leaves[placed.leaf];
  instance_ = leaf_box.instance;
  world_from_leaf_ = placed.world_from_leaf;
  box_ = leaf_box.box;
  samples_.clear();
  pixels_.clear();

  // A mirror turns faces inside out.
  const bool is_mirrored =
      glm::determinant(glm::dmat3(placed.world_from_leaf)) < 0;
  for (const csg::Loft& loft : leaf.lofts) {
    sample_loft(loft, is_mirrored != loft.is_cavity);
  }
  for (const csg::Mesh& mesh : leaf.meshes) sample_mesh(mesh, is_mirrored);

  out.images.push_back({leaf_box, out.ends.size()});
  sort_by_pixel(out);
}

// --- Lofts ------------------------------------------------------------------

void ScanlineSampler::sample_loft(const csg::Loft& loft, bool is_inside_out) {
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

void ScanlineSampler::place_loft(const csg::Loft& loft) {
  filled_ring_ = loft.profile.size();
  outline_.clear();
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const Vec2& point : *loft.outline) {
    outline_.push_back(world_from_leaf_ * Vec4(point, 0, 0));
    lowest = std::min(lowest, outline_.back().z);
    highest = std::max(highest, outline_.back().z);
  }
  scales_.clear();
  centres_.clear();
  ring_levels_.clear();
  for (const Vec2& ring : loft.profile) {
    scales_.push_back(ring.x);
    centres_.push_back(world_from_leaf_ * Vec4(0, 0, ring.y, 1));
    // Rounding keeps order, so these bound the levels of all vertices.
    ring_levels_.push_back(
        {layers_.layers_below(ring.x * lowest + centres_.back().z),
         layers_.layers_below(ring.x * highest + centres_.back().z)});
  }
}

// Finds the levels of a ring's vertices.
void ScanlineSampler::fill_ring(std::size_t ring,
                                std::vector<std::uint32_t>& levels) const {
  const auto [low, high] = ring_levels_[ring];
  levels.assign(outline_.size(), low);
  if (low == high) return;
  for (std::size_t j = 0; j < outline_.size(); ++j) {
    levels[j] =
        layers_.layers_below(scales_[ring] * outline_[j].z + centres_[ring].z);
  }
}

// Samples the side quads between two rings.
void ScanlineSampler::cross_strip(std::size_t low, std::size_t high,
                                  bool is_inside_out) {
  const LevelRange a = ring_levels_[low];
  const LevelRange b = ring_levels_[high];
  const LevelRange all{std::min(a.low, b.low), std::max(a.high, b.high)};
  if (all.low == all.high || !meets_box(all)) return;
  if (filled_ring_ == low) {
    std::swap(low_levels_, high_levels_);
  } else {
    fill_ring(low, low_levels_);
  }
  fill_ring(high, high_levels_);
  filled_ring_ = high;
  std::size_t j = outline_.size() - 1;
  for (std::size_t next = 0; next < outline_.size(); j = next++) {
    const std::array<std::uint32_t, 4> levels = {
        low_levels_[j], low_levels_[next], high_levels_[next], high_levels_[j]};
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

void ScanlineSampler::cross_cap(std::size_t ring, bool is_inside_out) {
  const LevelRange all = ring_levels_[ring];
  if (all.low == all.high || !meets_box(all)) return;
  fill_ring(ring, low_levels_);
  cap_.clear();
  for (std::size_t j = 0; j < outline_.size(); ++j) {
    cap_.push_back({loft_vertex(ring, j), low_levels_[j]});
  }
  if (is_inside_out) std::reverse(cap_.begin(), cap_.end());
  cross_face(cap_);
}

// --- Meshes -----------------------------------------------------------------

void ScanlineSampler::sample_mesh(const csg::Mesh& mesh, bool is_inside_out) {
  vertices_.clear();
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 position = world_from_leaf_ * Vec4(vertex, 1);
    vertices_.push_back({position, layers_.layers_below(position.z)});
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto [low, high] = std::minmax(
        {vertices_[a].level, vertices_[b].level, vertices_[c].level});
    if (low == high || !meets_box({low, high})) continue;
    std::array<Corner, 3> corners = {vertices_[a], vertices_[b], vertices_[c]};
    if (is_inside_out) std::swap(corners[1], corners[2]);
    cross_face(corners);
  }
}

// --- Faces ------------------------------------------------------------------

// Samples a planar face whose corners run counter-clockwise from outside.
void ScanlineSampler::cross_face(std::span<const Corner> corners) {
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
  if (rays_.rays_below(left) == rays_.rays_below(right)) return;
  has_normal_ = false;
  const std::uint32_t end = std::min(high, box_.layer_end());
  for (std::uint32_t layer = std::max(low, box_.layer_start); layer < end;
       ++layer) {
    cross_layer(corners, layer);
  }
}

void ScanlineSampler::cross_layer(std::span<const Corner> corners,
                                  std::uint32_t layer) {
  const double z = layers_.section_z(layer);
  begins_.clear();
  ends_.clear();
  const Corner* from = &corners.back();
  for (const Corner& to : corners) {
    const bool from_above = from->level > layer;
    if (from_above != (to.level > layer)) {
      if (from_above) {
        begins_.push_back(point_on_edge(to.position, from->position, z));
      } else {
        ends_.push_back(point_on_edge(from->position, to.position, z));
      }
    }
    from = &to;
  }
  if (begins_.size() > 1) {
    // A face that is not convex: its segments follow one another on one line,
    // all in the direction from begin to end, so the k-th begin belongs to the
    // k-th end. By rounding they may mix up; the ends stay the same points.
    const Vec2 across = ends_[0] - begins_[0];
    const bool sorts_by_x = std::abs(across.x) >= std::abs(across.y);
    const auto comes_first = [sorts_by_x](const Vec2& a, const Vec2& b) {
      return sorts_by_x ? a.x < b.x : a.y < b.y;
    };
    std::sort(begins_.begin(), begins_.end(), comes_first);
    std::sort(ends_.begin(), ends_.end(), comes_first);
  }
  for (std::size_t i = 0; i < begins_.size(); ++i) {
    cross_segment({begins_[i], ends_[i]}, layer, corners);
  }
}

void ScanlineSampler::cross_segment(const Segment& segment, std::uint32_t layer,
                                    std::span<const Corner> corners) {
  const bool is_entry = segment.begin.x < segment.end.x;
  const Vec2 left = is_entry ? segment.begin : segment.end;
  const Vec2 right = is_entry ? segment.end : segment.begin;
  const std::uint32_t begin =
      std::max(rays_.rays_below(left.x), box_.ray_start);
  const std::uint32_t end = std::min(rays_.rays_below(right.x), box_.ray_end());
  if (begin >= end) return;

  if (!has_normal_) {
    normal_ = polygon_normal(corners);
    has_normal_ = true;
  }
  Sample sample{0, sample_normal(normal_, is_entry), instance_};
  const double slope = (right.y - left.y) / (right.x - left.x);
  const auto [low, high] = std::minmax(left.y, right.y);
  const std::size_t row =
      std::size_t{layer - box_.layer_start} * box_.ray_count - box_.ray_start;
  for (std::uint32_t ray = begin; ray < end; ++ray) {
    const double y = left.y + (rays_.ray_x(ray) - left.x) * slope;
    sample.depth = std::clamp(y, low, high);
    samples_.push_back(sample);
    pixels_.push_back(static_cast<std::uint32_t>(row + ray));
  }
}

// Appends the samples to `out` by a counting sort.
void ScanlineSampler::sort_by_pixel(LeafImages& out) {
  const std::size_t first_sample = out.samples.size();
  const std::size_t first_pixel = out.ends.size();
  out.samples.resize(first_sample + samples_.size());
  out.ends.resize(first_pixel + box_.pixel_count(), 0);
  const std::span<std::uint32_t> ends_of_image =
      std::span(out.ends).subspan(first_pixel);
  for (const std::uint32_t pixel : pixels_) ++ends_of_image[pixel];
  std::exclusive_scan(ends_of_image.begin(), ends_of_image.end(),
                      ends_of_image.begin(),
                      static_cast<std::uint32_t>(first_sample));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    out.samples[ends_of_image[pixels_[i]]++] = samples_[i];
  }
}

}  // namespace

std::unique_ptr<Sampler> make_scanline_sampler(const csg::Scene& scene,
                                               const RayGrid& rays,
                                               const LayerGrid& layers) {
  return std::make_unique<ScanlineSampler>(scene, rays, layers);
}

}  // namespace lamina::ldni
