#include "csg/lower/emptiness.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace lamina::csg {
namespace {

constexpr std::size_t kMostNotes = 3;
constexpr int kMostNodes = 10'000;

// Also of what is no number.
bool is_nothing(double length) { return !(length > 0) || std::isinf(length); }

std::string fault_of(const char* module, const char* what, double length) {
  return is_nothing(length)
             ? fmt::format("{}() with a {} of {:g} mm is nothing", module, what,
                           length)
             : "";
}

// --- Why one object is nothing; "" where it may be something ----------------

std::string fault_of(const Cube& cube) {
  const Vec3 s = cube.size;
  if (!is_nothing(s.x) && !is_nothing(s.y) && !is_nothing(s.z)) return "";
  return fmt::format("cube() of {:g} x {:g} x {:g} mm is nothing", s.x, s.y,
                     s.z);
}

std::string fault_of(const Sphere& sphere) {
  return fault_of("sphere", "radius", sphere.r);
}

std::string fault_of(const Cylinder& cylinder) {
  if (is_nothing(cylinder.h)) {
    return fault_of("cylinder", "height", cylinder.h);
  }
  const bool has_wrong_end = cylinder.r1 < 0 || cylinder.r2 < 0;
  return has_wrong_end || is_nothing(cylinder.r1 + cylinder.r2)
             ? fmt::format(
                   "cylinder() with radii of {:g} and {:g} mm is nothing",
                   cylinder.r1, cylinder.r2)
             : "";
}

std::string fault_of(const Square& square) {
  const Vec2 s = square.size;
  if (!is_nothing(s.x) && !is_nothing(s.y)) return "";
  return fmt::format("square() of {:g} x {:g} mm is nothing", s.x, s.y);
}

std::string fault_of(const Circle& circle) {
  return fault_of("circle", "radius", circle.r);
}

std::string fault_of(const Polygon& polygon) {
  if (polygon.params->paths) return "";
  const auto points = polygon.params->points;
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i];
    const Vec2 b = points[(i + 1) % points.size()];
    area += a.x * b.y - a.y * b.x;
  }
  return area == 0 ? "polygon() that encloses no area is nothing" : "";
}

std::string fault_of(const Polyhedron& polyhedron) {
  return polyhedron.params->faces.empty()
             ? "polyhedron() without faces is nothing"
             : "";
}

std::string fault_of(const Text& text) {
  if (text.params->text.empty()) return "text() without letters is nothing";
  return fault_of("text", "size", text.params->size);
}

std::string fault_of(const LinearExtrude& extrude) {
  return fault_of("linear_extrude", "height", extrude.params->height);
}

template <typename Op>
std::string fault_of(const Op& /*op*/) {
  return "";
}

// Files have messages of their own.
bool is_object(const Node& node) {
  return !std::holds_alternative<Group>(node.op) &&
         !std::holds_alternative<Import>(node.op) &&
         !std::holds_alternative<Surface>(node.op);
}

const char* cut_of(const Node& node) {
  return std::holds_alternative<Difference>(node.op)     ? "difference"
         : std::holds_alternative<Intersection>(node.op) ? "intersection"
         : std::holds_alternative<Offset>(node.op)       ? "offset"
         : std::holds_alternative<Projection>(node.op)   ? "projection"
                                                         : nullptr;
}

class Search {
 public:
  void visit(const Node& node) {
    if (notes.size() >= kMostNotes || ++visited_ > kMostNodes) return;
    if (node.is_background) return;
    const std::string fault =
        std::visit([](const auto& op) { return fault_of(op); }, node.op);
    if (!fault.empty()) {
      has_leaf = true;
      return add(node, fault);
    }
    if (node.children.empty()) {
      has_leaf = has_leaf || !std::holds_alternative<Group>(node.op);
      leaves_ += is_object(node) ? 1 : 0;
    }
    const std::size_t before = notes.size();
    const int leaves_before = leaves_;
    const bool is_difference = std::holds_alternative<Difference>(node.op);
    for (const Node* child : node.children) {
      visit(*child);
      if (is_difference) break;  // what is taken away says nothing
    }
    const char* const cut = cut_of(node);
    if (cut != nullptr && leaves_ > leaves_before && notes.size() == before) {
      add(node, fmt::format("{}() leaves nothing", cut));
    }
  }

  std::vector<Note> notes;
  bool has_leaf = false;

 private:
  void add(const Node& node, std::string words) {
    notes.push_back({node.range, std::move(words)});
  }

  int visited_ = 0;
  int leaves_ = 0;
};

}  // namespace

std::vector<Note> why_empty(const Tree& tree) {
  Search search;
  if (tree.root != nullptr) search.visit(*tree.root);
  if (!search.has_leaf && search.notes.empty()) {
    return hint_of(
        "the design makes no object; those marked with * or % do not count");
  }
  return std::move(search.notes);
}

}  // namespace lamina::csg
