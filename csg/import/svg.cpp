#include "csg/import/svg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
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

using Matrix = glm::dmat3;

// The whole attribute as a number; 0 where it is not one, as "3mm".
double number_of(const pugi::xml_node& element, const char* attribute) {
  return to_number<double>(element.attribute(attribute).value()).value_or(0);
}

// Elements that OpenSCAD knows; all others only hold their children.
bool is_known(std::string_view name) {
  constexpr std::string_view kNames[] = {
      "circle",   "ellipse", "g",     "line", "path", "polygon",
      "polyline", "rect",    "tspan", "text", "use"};
  return std::find(std::begin(kNames), std::end(kNames), name) !=
         std::end(kNames);
}

bool is_group(std::string_view name) {
  return name == "g" || name == "text" || name == "tspan";
}

// Where in the drawing an element stands.
struct Place {
  Matrix page_from_parent = Matrix(1.0);
  bool is_shown = true;     // by the filter, and by display
  bool is_in_layer = true;  // that the filter names, or it names none
  bool is_in_defs = false;  // only kept, for <use>
  bool is_copy = false;     // below a <use>
  int depth = 0;
};

class SvgReader {
 public:
  explicit SvgReader(const SvgOptions& options) : options_(options) {}

  SvgDrawing read(const pugi::xml_node& document) {
    Place top;
    top.is_shown = !has_filter();
    top.is_in_layer = !options_.layer;
    drawing_.has_match = top.is_shown;
    read_children(document, top);
    place_on_page();
    return std::move(drawing_);
  }

 private:
  bool has_filter() const { return options_.id || options_.layer; }

  void read_children(const pugi::xml_node& parent, const Place& place) {
    if (place.depth > kMostNesting) {
      throw FormatError(fmt::format("SVG elements are nested more than {} deep",
                                    kMostNesting));
    }
    for (const pugi::xml_node child : parent.children()) {
      read_element(child, place);
    }
  }

  // What the filter and display say of an element decides of all below it, up
  // to where they say something else.
  void read_element(const pugi::xml_node& element, Place place) {
    const std::string_view name = element.name();
    ++place.depth;
    if (name == "svg")
      page_ = read_svg_page(element, options_.dpi, options_.language);
    if (name == "defs") place.is_in_defs = true;
    if (is_known(name)) {
      if (is_selected(element, place)) {
        place.is_shown = drawing_.has_match = true;
      } else if (!is_2021() && has_display_none(element)) {
        place.is_shown = false;
      }
      const std::string_view id = element.attribute("id").value();
      if (place.is_in_defs && !id.empty()) defined_.try_emplace(id, element);
    }
    if (name == "use") {
      read_use(element, place);
    } else if (place.is_shown && !place.is_in_defs) {
      read_shape(name, element, place.page_from_parent);
    }
    if (is_group(name)) {
      place.page_from_parent = place.page_from_parent * transform_of(element);
    }
    read_children(element, place);
  }

  bool is_2021() const { return options_.language == Language::k2021; }

  // Also notes whether the layer that the filter names begins here.
  bool is_selected(const pugi::xml_node& element, Place& place) const {
    if (!has_filter()) return false;
    const pugi::xml_attribute label = element.attribute("inkscape:label");
    const bool is_layer = options_.layer && !label.empty() &&
                          label.value() == *options_.layer &&
                          element.attribute("inkscape:groupmode").value() ==
                              std::string_view("layer");
    if (is_layer) place.is_in_layer = true;
    if (!options_.id) return is_layer;
    const pugi::xml_attribute id = element.attribute("id");
    return place.is_in_layer && !id.empty() && id.value() == *options_.id;
  }

  // Draws what the element names; as in OpenSCAD only what <defs> above it
  // hold, and nothing that these use themselves.
  void read_use(const pugi::xml_node& element, Place place) {
    if (place.is_copy || place.is_in_defs) return;
    std::string_view target = element.attribute("href").value();
    if (target.empty()) target = element.attribute("xlink:href").value();
    const auto found = target.starts_with('#') && !is_2021()
                           ? defined_.find(target.substr(1))
                           : defined_.end();
    if (found == defined_.end()) {
      note_undrawn(fmt::format("<use> of '{}'", target));
      return;
    }
    const Vec2 shift(number_of(element, "x"), number_of(element, "y"));
    Matrix moved(1.0);
    moved[2] = Vec3(shift, 1);
    place.page_from_parent =
        place.page_from_parent * transform_of(element) * moved;
    place.is_copy = true;
    read_element(found->second, place);
  }

  void note_undrawn(std::string words) {
    auto& undrawn = drawing_.undrawn;
    if (std::find(undrawn.begin(), undrawn.end(), words) == undrawn.end()) {
      undrawn.push_back(std::move(words));
    }
  }

  static Matrix transform_of(const pugi::xml_node& element) {
    return read_svg_transforms(element.attribute("transform").value());
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
    } else if (name == "text" || name == "image") {
      note_undrawn(fmt::format("<{}>", name));
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
    drawing_.shapes.push_back(std::exchange(contours_, {}));
  }

  void draw(std::vector<Vec2> path, const pugi::xml_node& element) {
    for (auto& contour :
         options_.outline(path, read_svg_stroke(element, options_.language))) {
      contours_.push_back(std::move(contour));
    }
  }

  void add_path(std::string_view data, const pugi::xml_node& element) {
    for (SvgSubpath& path : parse_svg_path(data, options_.curves)) {
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
    const int sides =
        lines_of_ellipse(options_.curves, std::max(radii.x, radii.y));
    std::vector<Vec2>& points = contours_.emplace_back();
    for (int i = 1; i <= sides; ++i) {
      const double angle = i * 360.0 / sides;
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
    for (SvgContours& shape : drawing_.shapes) {
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
  SvgDrawing drawing_;
  std::map<std::string_view, pugi::xml_node> defined_;  // by id
  Vec2 low_ = Vec2(1e300);
  Vec2 high_ = Vec2(-1e300);
};

}  // namespace

SvgDrawing parse_svg(std::string_view bytes, const SvgOptions& options) {
  pugi::xml_document document;
  parse_xml(bytes, "SVG", document);
  return SvgReader(options).read(document);
}

}  // namespace lamina::csg
