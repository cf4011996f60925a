#include "csg/import/svg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/mat3x3.hpp>

#include "csg/degrees.h"
#include "csg/import/detail/svg_numbers.h"
#include "csg/import/detail/svg_parts.h"
#include "csg/import/detail/xml.h"

namespace lamina::csg {
namespace {

// Elements are visited by a function that calls itself.
constexpr int kMostNesting = 500;

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

Matrix read_transforms(std::string_view text) {
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

// The whole attribute as a number; 0 where it is not one, as "3mm".
double number_of(const pugi::xml_node& element, const char* attribute) {
  return to_number<double>(element.attribute(attribute).value()).value_or(0);
}

// The value of an attribute, or else that of the element's own style.
std::string_view presentation(const pugi::xml_node& element, const char* name) {
  const std::string_view own = element.attribute(name).value();
  if (!own.empty()) return own;
  std::string_view style = element.attribute("style").value();
  while (!style.empty()) {
    const std::size_t end = std::min(style.find(';'), style.size());
    const std::string_view entry = style.substr(0, end);
    const std::size_t colon = std::min(entry.find(':'), entry.size());
    // OpenSCAD compares to the letter, blanks included.
    if (entry.substr(0, colon) == name && colon < entry.size()) {
      return entry.substr(colon + 1);
    }
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return {};
}

SvgStroke read_stroke(const pugi::xml_node& element) {
  constexpr double kThinnest = 0.01;
  SvgStroke stroke;
  const double width =
      to_number<double>(presentation(element, "stroke-width")).value_or(0);
  if (width >= kThinnest) stroke.width = width;
  const std::string_view cap = presentation(element, "stroke-linecap");
  if (cap == "butt") stroke.cap = SvgStroke::Cap::kButt;
  if (cap == "round") stroke.cap = SvgStroke::Cap::kRound;
  const std::string_view join = presentation(element, "stroke-linejoin");
  if (join == "bevel") stroke.join = SvgStroke::Join::kBevel;
  if (join == "round") stroke.join = SvgStroke::Join::kRound;
  return stroke;
}

class Reader {
 public:
  explicit Reader(const SvgOptions& options) : options_(options) {}

  std::vector<SvgContours> read(const pugi::xml_node& document) {
    read_children(document, Matrix(1.0), 0);
    place_on_page();
    return std::move(shapes_);
  }

 private:
  void read_children(const pugi::xml_node& parent, const Matrix& outer,
                     int depth) {
    if (depth > kMostNesting) {
      throw FormatError(fmt::format("SVG elements are nested more than {} deep",
                                    kMostNesting));
    }
    for (const pugi::xml_node child : parent.children()) {
      const std::string_view name = child.name();
      if (name == "defs") continue;
      if (name == "svg") {
        page_ = read_svg_page(child, options_.dpi);
      }
      const bool is_group = name == "g" || name == "text" || name == "tspan";
      const Matrix own = is_group ? outer * transform_of(child) : outer;
      read_shape(name, child, outer);
      read_children(child, own, depth + 1);
    }
  }

  static Matrix transform_of(const pugi::xml_node& element) {
    return read_transforms(element.attribute("transform").value());
  }

  void read_shape(std::string_view name, const pugi::xml_node& element,
                  const Matrix& outer) {
    contours_.clear();
    const auto number = [&element](const char* attribute) {
      return number_of(element, attribute);
    };
    if (name == "path") {
      add_path(element.attribute("d").value(), element);
    } else if (name == "rect") {
      add_rectangle(element);
    } else if (name == "circle") {
      add_ellipse({number("cx"), number("cy")}, Vec2(number("r")));
    } else if (name == "ellipse") {
      add_ellipse({number("cx"), number("cy")}, {number("rx"), number("ry")});
    } else if (name == "line") {
      draw({{number("x1"), number("y1")}, {number("x2"), number("y2")}},
           element);
    } else if (name == "polyline") {
      draw(read_points(element), element);
    } else if (name == "polygon") {
      contours_.push_back(read_points(element));
    }
    if (contours_.empty()) return;
    const Matrix whole = outer * transform_of(element);
    for (std::vector<Vec2>& contour : contours_) {
      for (Vec2& point : contour) {
        point = Vec2(whole * Vec3(point, 1));
        const Vec2 scaled = page_.scale * point;
        low_ = {std::min(low_.x, scaled.x), std::min(low_.y, scaled.y)};
        high_ = {std::max(high_.x, scaled.x), std::max(high_.y, scaled.y)};
      }
    }
    shapes_.push_back(std::exchange(contours_, {}));
  }

  void draw(std::vector<Vec2> path, const pugi::xml_node& element) {
    for (auto& contour : options_.outline(path, read_stroke(element))) {
      contours_.push_back(std::move(contour));
    }
  }

  void add_path(std::string_view data, const pugi::xml_node& element) {
    for (SvgSubpath& path : parse_svg_path(data)) {
      if (path.is_drawn) {
        draw(std::move(path.points), element);
      } else {
        contours_.push_back(std::move(path.points));
      }
    }
  }

  static std::vector<Vec2> read_points(const pugi::xml_node& element) {
    SvgNumbers numbers(element.attribute("points").value());
    std::vector<Vec2> points;
    for (;;) {
      const auto x = numbers.next();
      const auto y = numbers.next();
      if (!x || !y) return points;
      points.emplace_back(*x, *y);
    }
  }

  void add_ellipse(Vec2 center, Vec2 radii) {
    constexpr int kSides = 40;
    std::vector<Vec2>& points = contours_.emplace_back();
    for (int i = 1; i <= kSides; ++i) {
      const double angle = i * 360.0 / kSides;
      points.push_back(center + radii * Vec2(sin_deg(angle), cos_deg(angle)));
    }
  }

  void add_rectangle(const pugi::xml_node& element) {
    const double x = number_of(element, "x");
    const double y = number_of(element, "y");
    const double width = number_of(element, "width");
    const double height = number_of(element, "height");
    double rx = number_of(element, "rx");
    double ry = number_of(element, "ry");
    constexpr double kSharp = 1e-8;
    if (std::abs(rx) < kSharp && std::abs(ry) < kSharp) {
      contours_.push_back(
          {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
      return;
    }
    if (std::abs(rx) < kSharp) rx = ry;
    if (std::abs(ry) < kSharp) ry = rx;
    rx = std::min(rx, width / 2);
    ry = std::min(ry, height / 2);
    // OpenSCAD writes this path, too, with six digits.
    add_path(
        fmt::format("M{:g},{:g} H{:g} A{:g},{:g} 0 0,1 {:g},{:g} V{:g} "
                    "A{:g},{:g} 0 0,1 {:g},{:g} H{:g} A{:g},{:g} 0 0,1 "
                    "{:g},{:g} V{:g} A{:g},{:g} 0 0,1 {:g},{:g} z",
                    x + rx, y, x + width - rx, rx, ry, x + width, y + ry,
                    y + height - ry, rx, ry, x + width - rx, y + height, x + rx,
                    rx, ry, x, y + height - ry, y + ry, rx, ry, x + rx, y),
        element);
  }

  void place_on_page() {
    const Vec2 middle = (low_ + high_) / 2.0;
    const Vec2 shift = options_.center
                           ? Vec2(-middle.x, middle.y)
                           : Vec2(page_.shift.x, page_.height - page_.shift.y);
    for (SvgContours& shape : shapes_) {
      for (std::vector<Vec2>& contour : shape) {
        for (Vec2& point : contour) {
          point = page_.scale * Vec2(point.x - page_.view_low.x,
                                     -page_.view_low.y - point.y) +
                  shift;
        }
      }
    }
  }

  const SvgOptions& options_;
  SvgPage page_;
  SvgContours contours_;  // of the shape being read
  std::vector<SvgContours> shapes_;
  Vec2 low_ = Vec2(1e300);
  Vec2 high_ = Vec2(-1e300);
};

}  // namespace

std::vector<SvgContours> parse_svg(std::string_view bytes,
                                   const SvgOptions& options) {
  pugi::xml_document document;
  parse_xml(bytes, "SVG", document);
  return Reader(options).read(document);
}

}  // namespace lamina::csg
