#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "csg/import/detail/svg_numbers.h"
#include "csg/import/detail/svg_parts.h"

namespace lamina::csg {
namespace {

constexpr double kInch = 25.4;  // mm

struct ViewBox {
  Vec2 low = Vec2(0);
  Vec2 size = Vec2(0);
};

std::optional<ViewBox> read_view_box(std::string_view text) {
  SvgNumbers numbers(text);
  double values[4] = {};
  for (double& value : values) {
    const auto number = numbers.next();
    if (!number) return std::nullopt;
    value = *number;
  }
  if (numbers.peek() != '\0' || !(values[2] >= 0 && values[3] >= 0)) {
    return std::nullopt;
  }
  return ViewBox{{values[0], values[1]}, {values[2], values[3]}};
}

// A side of the page.
struct Length {
  double mm = 0;
  double share = 1;  // of the viewBox that a page in percent shows
};

// view  the side of the viewBox; 0 if there is none
Length read_length(std::string_view text, double view, double dpi,
                   Language rules) {
  static const std::map<std::string_view, double> kUnits = {
      {"px", kInch / 96}, {"pt", kInch / 72}, {"pc", kInch / 6},
      {"in", kInch},      {"cm", 10},         {"mm", 1}};
  SvgNumbers numbers(text);
  const auto number = numbers.next();
  const std::string_view unit = trim(numbers.rest());
  if (number && unit.empty()) return {*number * kInch / dpi};
  if (number && unit == "%") {
    const double share = *number / 100;
    // In 2021.01 such a page has the whole viewBox, in millimetres.
    if (rules == Language::k2021) return {view};
    return {share * view * kInch / dpi, share};
  }
  if (number && (unit == "em" || unit == "ex")) return {view};
  const auto found = kUnits.find(unit);
  if (number && found != kUnits.end()) return {*number * found->second};
  return {view * kInch / dpi};
}

struct Alignment {
  bool is_uniform = true;  // scale
  bool is_slice = false;   // the drawing fills the page; else it fits in
  Vec2 share = Vec2(0.5);  // of the room left, in front of the drawing
};

Alignment read_alignment(std::string_view text) {
  static const std::map<std::string_view, double> kShares = {
      {"Min", 0.0}, {"Mid", 0.5}, {"Max", 1.0}};
  std::string_view word = take_word(text);
  if (word == "defer") word = take_word(text);
  Alignment alignment;
  if (word == "none") alignment.is_uniform = false;
  if (word.size() == 8 && word[0] == 'x' && word[4] == 'Y') {
    const auto x = kShares.find(word.substr(1, 3));
    const auto y = kShares.find(word.substr(5, 3));
    if (x != kShares.end() && y != kShares.end()) {
      alignment.share = {x->second, y->second};
    }
  }
  alignment.is_slice = take_word(text) == "slice";
  return alignment;
}

}  // namespace

SvgPage read_svg_page(const pugi::xml_node& svg, double dpi, Language rules) {
  const auto box = read_view_box(svg.attribute("viewBox").value());
  const auto side = [&](const char* name, int axis) {
    const double view = box ? box->size[axis] : 0;
    return read_length(svg.attribute(name).value(), view, dpi, rules);
  };
  const Length width = side("width", 0);
  const Length height = side("height", 1);
  const Vec2 size(width.mm, height.mm);
  SvgPage page;
  page.height = size.y;
  if (!box) return page;
  page.view_low = box->low * Vec2(width.share, height.share);
  page.scale = size / box->size;
  const Alignment alignment =
      read_alignment(svg.attribute("preserveAspectRatio").value());
  if (!alignment.is_uniform) return page;
  page.scale = Vec2(alignment.is_slice ? std::max(page.scale.x, page.scale.y)
                                       : std::min(page.scale.x, page.scale.y));
  page.shift = alignment.share * (size - page.scale * box->size);
  return page;
}

}  // namespace lamina::csg
