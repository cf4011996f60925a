#include "csg/design_text.h"

#include <fmt/format.h>

namespace lamina::csg {

std::string design_text(double length) {
  std::string text = fmt::format("{:.3f}", length);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string design_text(Vec3 place) {
  return fmt::format("[{}, {}, {}]", design_text(place.x), design_text(place.y),
                     design_text(place.z));
}

}  // namespace lamina::csg
