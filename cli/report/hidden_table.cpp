#include "cli/report/hidden_table.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/report/feature_table.h"

namespace lamina::cli {
namespace {

const char* kind_of(const slicer::ThinPlace& place) {
  if (place.is_gap) return "gap";
  return place.shape == slicer::ThinShape::kWire ? "wire" : "wall";
}

}  // namespace

std::string hidden_table(
    const std::optional<std::vector<compiler::HiddenThin>>& hidden,
    double width) {
  if (!hidden) {
    return fmt::format(
        "thinner than {:g} mm, flat or leaning: not looked for, the part is "
        "too large\n",
        width);
  }
  if (hidden->empty()) return {};
  std::string text = fmt::format("thinner than {:g} mm, flat or leaning: {}\n",
                                 width, counted(hidden->size(), "place"));
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:>9} {:>8} {:>11} {:>10} {:>10} {:>10}  {}\n",
                 "width mm", "", "mm²", "at z", "x", "y", "surface of");
  const std::size_t listed = std::min(hidden->size(), kMostLines);
  for (const auto& [place, lines] : std::span(*hidden).first(listed)) {
    fmt::format_to(out, "{:>9.4f} {:>8} {:>11.3g} {:>10.4f} {:>10.4f} ",
                   place.width, kind_of(place), place.area, place.place.z,
                   place.place.x);
    fmt::format_to(out, "{:>10.4f}  {}\n", place.place.y,
                   compiler::text_of(lines));
  }
  if (listed < hidden->size()) {
    fmt::format_to(out, "  … and {} more lines\n", hidden->size() - listed);
  }
  return text;
}

}  // namespace lamina::cli
