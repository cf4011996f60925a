#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "csg/degrees.h"
#include "csg/import/detail/svg_numbers.h"
#include "csg/import/detail/svg_parts.h"

namespace lamina::csg {
namespace {

// The matrix [a b c d e f]: (x, y) becomes (a x + c y + e, b x + d y + f).
using Matrix = glm::dmat3;
Matrix matrix(double a, double b, double c, double d, double e, double f) {
  return {a, b, 0, c, d, 0, e, f, 1};
}

Matrix rotation(double angle_deg, Vec2 center) {
  const double cos = cos_deg(angle_deg);
  const double sin = sin_deg(angle_deg);
  return matrix(1, 0, 0, 1, center.x, center.y) *
         (matrix(cos, sin, -sin, cos, 0, 0) *
          matrix(1, 0, 0, 1, -center.x, -center.y));
}

double tan_deg(double angle_deg) {
  return sin_deg(angle_deg) / cos_deg(angle_deg);
}

// One function of a transform; the identity for a wrong number of arguments.
Matrix read_transform(std::string_view name, const std::vector<double>& v) {
  const std::size_t n = v.size();
  if (name == "matrix" && n == 6) {
    return matrix(v[0], v[1], v[2], v[3], v[4], v[5]);
  }
  if (name == "translate" && (n == 1 || n == 2)) {
    return matrix(1, 0, 0, 1, v[0], n == 2 ? v[1] : 0);
  }
  if (name == "scale" && (n == 1 || n == 2)) {
    return matrix(v[0], 0, 0, v[n - 1], 0, 0);
  }
  if (name == "rotate" && n == 1) return rotation(v[0], Vec2(0));
  if (name == "rotate" && n == 3) return rotation(v[0], {v[1], v[2]});
  if (name == "skewX" && n == 1) return matrix(1, 0, tan_deg(v[0]), 1, 0, 0);
  if (name == "skewY" && n == 1) return matrix(1, tan_deg(v[0]), 0, 1, 0, 0);
  return Matrix(1.0);
}

// The value that an element's own style gives a property; empty: none.
std::string_view style_of(const pugi::xml_node& element, std::string_view name,
                          Language language) {
  // 2021.01 compares to the letter, blanks included.
  const auto read = [language](std::string_view text) {
    return language == Language::k2021 ? text : trim(text);
  };
  std::string_view style = element.attribute("style").value();
  while (!style.empty()) {
    const std::size_t end = std::min(style.find(';'), style.size());
    const std::string_view entry = style.substr(0, end);
    const std::size_t colon = std::min(entry.find(':'), entry.size());
    if (colon < entry.size() && read(entry.substr(0, colon)) == name) {
      return read(entry.substr(colon + 1));
    }
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return {};
}

}  // namespace

glm::dmat3 read_svg_transforms(std::string_view text) {
  Matrix whole(1.0);
  for (std::size_t open = text.find('('); open != std::string_view::npos;
       open = text.find('(')) {
    std::string_view name = text.substr(0, open);
    while (!name.empty() && (is_blank(name.front()) || name.front() == ',')) {
      name.remove_prefix(1);
    }
    const std::size_t close = std::min(text.find(')', open), text.size());
    SvgNumbers numbers(text.substr(open + 1, close - open - 1));
    std::vector<double> values;
    while (const auto number = numbers.next()) values.push_back(*number);
    whole = whole * read_transform(trim(name), values);
    text.remove_prefix(std::min(close + 1, text.size()));
  }
  return whole;
}

bool has_display_none(const pugi::xml_node& element) {
  const std::string_view style = style_of(element, "display", Language::k2026);
  const std::string_view own = element.attribute("display").value();
  return (style.empty() ? own : style) == "none";
}

SvgStroke read_svg_stroke(const pugi::xml_node& element, Language language) {
  constexpr double kThinnest = 0.01;
  const auto presentation = [&](const char* name) {
    const std::string_view own = element.attribute(name).value();
    return own.empty() ? style_of(element, name, language) : own;
  };
  SvgStroke stroke;
  const double width =
      to_number<double>(presentation("stroke-width")).value_or(0);
  if (width >= kThinnest) stroke.width = width;
  if (language != Language::k2021) stroke.cap = SvgStroke::Cap::kButt;
  const std::string_view cap = presentation("stroke-linecap");
  if (cap == "butt") stroke.cap = SvgStroke::Cap::kButt;
  if (cap == "round") stroke.cap = SvgStroke::Cap::kRound;
  if (cap == "square") stroke.cap = SvgStroke::Cap::kSquare;
  const std::string_view join = presentation("stroke-linejoin");
  if (join == "bevel") stroke.join = SvgStroke::Join::kBevel;
  if (join == "round") stroke.join = SvgStroke::Join::kRound;
  return stroke;
}

}  // namespace lamina::csg
