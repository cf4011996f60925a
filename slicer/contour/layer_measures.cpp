#include "slicer/contour/layer_measures.h"

#include "base/loop_area.h"

namespace lamina::slicer {

LayerMeasures measure(const ldni::Contours& contours) {
  LayerMeasures measures;
  measures.loops = contours.loop_count();
  measures.vertices = contours.points.size();
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const double area = signed_area(contours.loop(i));
    measures.holes += area < 0 ? 1 : 0;
    measures.area += area;
  }
  return measures;
}

double total_perimeter(const ldni::Contours& contours) {
  double length = 0;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    length += perimeter(contours.loop(i));
  }
  return length;
}

}  // namespace lamina::slicer
