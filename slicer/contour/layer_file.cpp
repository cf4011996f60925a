#include "slicer/contour/layer_file.h"

#include <cstddef>

#include "base/text.h"

namespace lamina::slicer {

std::string left_out_text(const LayerFileFacts& facts) {
  constexpr std::size_t kMostKinds = 5;
  std::string text;
  std::size_t kinds = 0;
  if (facts.short_loops.count > 0) {
    text = counted(facts.short_loops.count, "loop of fewer than 3 points",
                   "loops of fewer than 3 points");
    ++kinds;
  }
  for (const auto& [kind, count] : facts.left_out) {
    if (kinds > 0) text += ", ";
    if (kinds++ == kMostKinds) return text + "…";
    text += counted(count, kind);
  }
  return text;
}

}  // namespace lamina::slicer
