#include "ldni/image/detail/face_projector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/matrix.hpp>

namespace lamina::ldni {
namespace {

constexpr std::int64_t kSteps = 1 << kSubPixelBits;

// Pixels that a corner may lie outside a picture: less than the margin by the
// pixel that it may be moved.
constexpr double kReach = kPictureMargin - 1;

// Returns `pixels` in whole steps, on the given side of the pixels' middles.
//
// middles_below  how many of the `count` middles are before the corner
std::int64_t snap(double pixels, std::uint32_t middles_below,
                  std::uint32_t count) {
  std::int64_t steps = std::llround(pixels * kSteps);
  const std::int64_t middle =
      std::int64_t{middles_below} * kSteps + kSteps / 2;  // the next one
  if (middles_below < count) steps = std::min(steps, middle - 1);
  if (middles_below > 0) steps = std::max(steps, middle - kSteps + 1);
  return steps;
}

float picture_coordinate(std::int64_t steps, std::uint32_t start) {
  return static_cast<float>(steps - std::int64_t{start} * kSteps) /
         static_cast<float>(kSteps);
}

enum class Keep { kAbove, kBelow };

// Cuts a convex polygon at a bound of one coordinate. Where it cuts an edge is
// computed from the inner end to the outer one, alike for both faces beside it.
void cut(std::vector<Vec3>& polygon, int axis, double bound, Keep keep) {
  const auto is_inside = [&](const Vec3& p) {
    return keep == Keep::kAbove ? p[axis] >= bound : p[axis] <= bound;
  };
  if (std::all_of(polygon.begin(), polygon.end(), is_inside)) return;
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& from = polygon[i];
    const Vec3& to = polygon[(i + 1) % polygon.size()];
    if (is_inside(from)) result.push_back(from);
    if (is_inside(from) == is_inside(to)) continue;
    const Vec3& inner = is_inside(from) ? from : to;
    const Vec3& outer = is_inside(from) ? to : from;
    const double t = (bound - inner[axis]) / (outer[axis] - inner[axis]);
    result.push_back(inner + t * (outer - inner));
    result.back()[axis] = bound;
  }
  polygon = std::move(result);
}

}  // namespace

void FaceProjector::place(const csg::Mesh& mesh,
                          const Affine& world_from_leaf) {
  mesh_ = &mesh;
  is_mirrored_ = glm::determinant(glm::dmat3(world_from_leaf)) < 0;
  nearest_ = std::numeric_limits<double>::max();
  farthest_ = std::numeric_limits<double>::lowest();
  vertices_.clear();
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 position = world_from_leaf * Vec4(vertex, 1);
    vertices_.push_back({position, rays_.rays_below(position.x),
                         layers_.layers_below(position.z)});
    nearest_ = std::min(nearest_, position.y);
    farthest_ = std::max(farthest_, position.y);
  }
}

void FaceProjector::project(const GridBox& picture) {
  picture_ = picture;
  set_reach();
  corners_.clear();
  faces_.clear();
  for (std::uint32_t face = 0; face < mesh_->triangles.size(); ++face) {
    if (can_meet(face)) add_face(face);
  }
}

// Whether a face can meet a ray of the picture: most faces of a fine mesh
// cannot.
bool FaceProjector::can_meet(std::uint32_t face) const {
  const auto& triangle = mesh_->triangles[face];
  const Vertex& a = vertices_[triangle[0]];
  const Vertex& b = vertices_[triangle[1]];
  const Vertex& c = vertices_[triangle[2]];
  const auto [bottom, top] =
      std::minmax({a.layers_below, b.layers_below, c.layers_below});
  if (bottom == top || bottom >= picture_.layer_end() ||
      top <= picture_.layer_start) {
    return false;
  }
  const auto [left, right] =
      std::minmax({a.rays_below, b.rays_below, c.rays_below});
  return left != right && left < picture_.ray_end() &&
         right > picture_.ray_start;
}

std::array<Vec3, 3> FaceProjector::corners_of(std::uint32_t face) const {
  auto [a, b, c] = mesh_->triangles[face];
  if (is_mirrored_) std::swap(b, c);
  return {vertices_[a].position, vertices_[b].position, vertices_[c].position};
}

void FaceProjector::set_reach() {
  const double x = rays_.ray_x(picture_.ray_start);
  const double z = layers_.section_z(picture_.layer_start);
  const double pitch = rays_.pitch();
  const double thickness = layers_.thickness();
  reach_low_ = Vec3(x - kReach * pitch, 0, z - kReach * thickness);
  reach_high_ = Vec3(x + (kPictureSize + kReach) * pitch, 0,
                     z + (kPictureSize + kReach) * thickness);
}

bool FaceProjector::is_in_reach(const Vec3& position) const {
  return position.x >= reach_low_.x && position.x <= reach_high_.x &&
         position.z >= reach_low_.z && position.z <= reach_high_.z;
}

void FaceProjector::add_face(std::uint32_t face) {
  const std::array<Vec3, 3> corners = corners_of(face);
  if (std::all_of(corners.begin(), corners.end(),
                  [this](const Vec3& p) { return is_in_reach(p); })) {
    add_triangle(face, corners);
  } else {
    cut_face(face);
  }
}

void FaceProjector::cut_face(std::uint32_t face) {
  const std::array<Vec3, 3> corners = corners_of(face);
  polygon_.assign(corners.begin(), corners.end());
  for (const int axis : {0, 2}) {
    cut(polygon_, axis, reach_low_[axis], Keep::kAbove);
    cut(polygon_, axis, reach_high_[axis], Keep::kBelow);
  }
  for (std::size_t i = 2; i < polygon_.size(); ++i) {
    add_triangle(face, {polygon_[0], polygon_[i - 1], polygon_[i]});
  }
}

void FaceProjector::add_triangle(std::uint32_t face,
                                 const std::array<Vec3, 3>& corners) {
  for (const Vec3& corner : corners) {
    corners_.push_back(raster_corner(corner));
  }
  faces_.push_back(face);
}

RasterCorner FaceProjector::raster_corner(const Vec3& position) const {
  const double column = (position.x - rays_.ray_x(0)) / rays_.pitch() + 0.5;
  const double row =
      (position.z - layers_.section_z(0)) / layers_.thickness() + 0.5;
  // Well inside of 0 and 1, whatever interpolation rounds.
  const double depth = 0.25 + 0.5 * (position.y - nearest_) /
                                  std::max(farthest_ - nearest_,
                                           std::numeric_limits<double>::min());
  return {picture_coordinate(
              snap(column, rays_.rays_below(position.x), rays_.ray_count()),
              picture_.ray_start),
          picture_coordinate(snap(row, layers_.layers_below(position.z),
                                  layers_.layer_count()),
                             picture_.layer_start),
          static_cast<float>(depth)};
}

}  // namespace lamina::ldni
