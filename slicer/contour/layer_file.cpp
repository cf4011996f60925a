#include "slicer/contour/layer_file.h"

namespace lamina::slicer {

std::vector<WrittenLoop> closed_loops(const ldni::Contours& contours) {
  std::vector<WrittenLoop> closed(contours.loop_count());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    closed[i].points.assign(loop.begin(), loop.end());
    if (!loop.empty()) closed[i].points.push_back(loop.front());
  }
  return closed;
}

}  // namespace lamina::slicer
