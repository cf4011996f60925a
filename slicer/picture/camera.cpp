#include "slicer/picture/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "base/check.h"

namespace lamina::slicer {
namespace {

// The near plane is no nearer than this share of the distance.
constexpr double kNearest = 0.1;

double radius_of(const Box3& box) { return glm::length(box.size()) / 2; }

}  // namespace

Camera Camera::from_numbers(std::span<const double> numbers) {
  Camera camera;
  if (numbers.size() == 7) {
    camera.center = {numbers[0], numbers[1], numbers[2]};
    camera.turn_deg = {numbers[3], numbers[4], numbers[5]};
    camera.distance = numbers[6];
    return camera;
  }
  LAMINA_CHECK_EQ(numbers.size(), std::size_t{6});
  const Vec3 eye(numbers[0], numbers[1], numbers[2]);
  camera.center = {numbers[3], numbers[4], numbers[5]};
  const Vec3 way = camera.center - eye;
  camera.distance = glm::length(way);
  const double level = std::hypot(way.x, way.y);
  const double azimuth = level == 0 ? (way.z < 0 ? 90.0 : -90.0)
                                    : glm::degrees(std::atan2(way.y, way.x));
  camera.turn_deg = {90 + glm::degrees(std::atan2(way.z, level)), 0,
                     azimuth - 90};
  return camera;
}

void Camera::center_on(const Box3& box) { center = box.center(); }

void Camera::show_all(const Box3& box) {
  const double radius = glm::length(box.center() - center) + radius_of(box);
  distance = radius / std::sin(glm::radians(field_deg / 2));
}

Mat4 Camera::view_from_world() const {
  // A viewer who looks along +y.
  const Mat4 view_from_front(Vec4(1, 0, 0, 0), Vec4(0, 0, -1, 0),
                             Vec4(0, 1, 0, 0), Vec4(0, 0, 0, 1));
  Mat4 turned = glm::translate(view_from_front, Vec3(0, distance, 0));
  turned = glm::rotate(turned, glm::radians(90 - turn_deg.x), Vec3(1, 0, 0));
  turned = glm::rotate(turned, glm::radians(-turn_deg.y), Vec3(0, 1, 0));
  turned = glm::rotate(turned, glm::radians(-turn_deg.z), Vec3(0, 0, 1));
  return glm::translate(turned, -center);
}

Mat4 Camera::clip_from_view(double aspect, const Box3& box) const {
  const double radius = 1.001 * radius_of(box) + 1e-9;
  const double depth = -(view_from_world() * Vec4(box.center(), 1)).z;
  if (projection == Projection::kPerspective) {
    const double near = std::max(depth - radius, kNearest * distance);
    return glm::perspective(glm::radians(field_deg), aspect, near,
                            std::max(depth + radius, 1.001 * near));
  }
  const double height = distance * std::tan(glm::radians(field_deg / 2));
  return glm::ortho(-height * aspect, height * aspect, -height, height,
                    depth - radius, depth + radius);
}

}  // namespace lamina::slicer
