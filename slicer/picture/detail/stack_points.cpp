#include "slicer/picture/detail/stack_points.h"

#include <algorithm>
#include <array>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "slicer/contour/layer_edges.h"
#include "slicer/picture/detail/trapezoids.h"

namespace lamina::slicer {
namespace {

// This many corners are sent to OpenGL at once.
constexpr std::size_t kMostCorners = 3 << 18;

class StackDrawer {
 public:
  StackDrawer(const Camera& camera, Vec3 origin, ldni::PointRaster& raster)
      : origin_(origin), raster_(raster) {
    const Mat4 world_from_view = glm::inverse(camera.view_from_world());
    is_perspective_ = camera.projection == Camera::Projection::kPerspective;
    eye_z_ = world_from_view[3].z;
    to_viewer_z_ = world_from_view[2].z;
  }

  // Draws from the nearest to the farthest, so that little is drawn twice.
  void draw(const std::vector<Layer>& layers,
            const std::vector<Plate>& plates) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const std::size_t at = to_viewer_z_ > 0 ? layers.size() - 1 - i : i;
      tag_ = static_cast<float>(at);
      add_sides(layers[at].contours, plates[at]);
      add_cap(layers[at].contours, plates[at]);
    }
    flush();
  }

 private:
  void add(double x, double y, double z) {
    corners_.push_back({static_cast<float>(x - origin_.x),
                        static_cast<float>(y - origin_.y),
                        static_cast<float>(z - origin_.z), tag_});
  }

  void add_quad(const std::array<Vec3, 4>& corners) {
    for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
      add(corners[i].x, corners[i].y, corners[i].z);
    }
    if (corners_.size() >= kMostCorners) flush();
  }

  void add_sides(const plane::Contours& contours, const Plate& plate) {
    visit_edges(contours, [&](Vec2 a, Vec2 b) {
      add_quad({Vec3(a, plate.bottom), Vec3(b, plate.bottom),
                Vec3(b, plate.top), Vec3(a, plate.top)});
    });
  }

  // The height of the plate's level side that the viewer can see, if any.
  std::optional<double> visible_side(const Plate& plate) const {
    const bool is_above =
        is_perspective_ ? eye_z_ > plate.top : to_viewer_z_ > 0;
    const bool is_below =
        is_perspective_ ? eye_z_ < plate.bottom : to_viewer_z_ < 0;
    if (is_above) return plate.top;
    if (is_below) return plate.bottom;
    return std::nullopt;
  }

  void add_cap(const plane::Contours& contours, const Plate& plate) {
    const std::optional<double> z = visible_side(plate);
    if (!z) return;
    if (cut_ == nullptr || *cut_ != contours) {
      cut_into_trapezoids(contours, trapezoids_);
      cut_ = &contours;
    }
    for (const Trapezoid& cut : trapezoids_) {
      add_quad({Vec3(cut.bottom_left, cut.bottom, *z),
                Vec3(cut.bottom_right, cut.bottom, *z),
                Vec3(cut.top_right, cut.top, *z),
                Vec3(cut.top_left, cut.top, *z)});
    }
  }

  void flush() {
    raster_.draw(corners_);
    corners_.clear();
  }

  Vec3 origin_;
  ldni::PointRaster& raster_;
  bool is_perspective_ = true;
  double eye_z_ = 0;
  double to_viewer_z_ = 1;
  float tag_ = 0;
  std::vector<ldni::TaggedPoint> corners_;
  const plane::Contours* cut_ = nullptr;  // into these
  std::vector<Trapezoid> trapezoids_;
};

}  // namespace

std::vector<Plate> plates_of(const std::vector<Layer>& layers) {
  std::vector<Plate> plates;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Layer& layer = layers[i];
    Plate plate = {layer.bottom, layer.top, layer.section_z};
    if (!(layer.top > layer.bottom)) {
      const double z = layer.section_z;
      if (i > 0) plate.bottom = (layers[i - 1].section_z + z) / 2;
      if (i + 1 < layers.size()) plate.top = (z + layers[i + 1].section_z) / 2;
    }
    plates.push_back(plate);
  }
  return plates;
}

Box3 bounds_of(const std::vector<Layer>& layers,
               const std::vector<Plate>& plates) {
  Box3 box;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    for (const Vec2& point : layers[i].contours.points) {
      box.add(Box3{Vec3(point, plates[i].bottom), Vec3(point, plates[i].top)});
    }
  }
  return box;
}

std::vector<ldni::TaggedPoint> find_stack_points(
    const std::vector<Layer>& layers, const std::vector<Plate>& plates,
    const Camera& camera, Vec3 origin, unsigned width, unsigned height) {
  const Mat4 clip_from_world =
      camera.clip_from_view(static_cast<double>(width) / height,
                            bounds_of(layers, plates)) *
      glm::translate(camera.view_from_world(), origin);
  std::array<float, 16> matrix{};
  std::copy_n(glm::value_ptr(glm::mat4(clip_from_world)), matrix.size(),
              matrix.begin());
  const auto osmesa = ldni::open_osmesa();
  ldni::PointRaster raster(*osmesa, width, height, matrix);
  StackDrawer(camera, origin, raster).draw(layers, plates);
  return raster.read();
}

}  // namespace lamina::slicer
