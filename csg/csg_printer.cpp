#include "csg/csg_printer.h"

#include <variant>

#include <glm/geometric.hpp>

#include "base/text.h"

namespace lamina::csg {

namespace {

// Appends strings as they are and numbers as streams show them.
class Writer {
 public:
  explicit Writer(std::string& text) : text_(text) {}
  Writer& operator<<(std::string_view piece) {
    text_ += piece;
    return *this;
  }
  Writer& operator<<(const char* piece) {
    return *this << std::string_view(piece);
  }
  Writer& operator<<(double number) {
    append_stream_number(number, text_);
    return *this;
  }
  Writer& operator<<(int number) {
    text_ += std::to_string(number);
    return *this;
  }
  Writer& operator<<(bool flag) { return *this << (flag ? "true" : "false"); }
  Writer& operator<<(const Facets& facets) {
    *this << "$fn = " << facets.fn;
    if (facets.fe > 0) *this << ", $fe = " << facets.fe;
    return *this << ", $fa = " << facets.fa << ", $fs = " << facets.fs;
  }
  std::string& text() { return text_; }

 private:
  std::string& text_;
};

// 2021.01 writes vectors as echo() does.
template <typename Vector>
void append_vector(const Vector& vector, int size, Language language,
                   std::string& text) {
  text += '[';
  for (int i = 0; i < size; ++i) {
    if (i > 0) text += ", ";
    language == Language::k2021 ? append_number(vector[i], text)
                                : append_stream_number(vector[i], text);
  }
  text += ']';
}

template <typename Vector>
void append_points(std::span<const Vector> points, int size, Language language,
                   std::string& text) {
  text += '[';
  for (const Vector& point : points) {
    if (&point != points.data()) text += ", ";
    append_vector(point, size, language, text);
  }
  text += ']';
}

void append_indices(std::span<const std::span<const std::uint32_t>> lists,
                    std::string& text) {
  text += '[';
  bool is_first = true;
  for (const std::span<const std::uint32_t>& list : lists) {
    text += is_first ? "[" : ", [";
    is_first = false;
    for (const std::uint32_t& index : list) {
      if (&index != list.data()) text += ", ";
      append_number(index, text);
    }
    text += ']';
  }
  text += ']';
}

struct OpPrinter {
  Writer out;
  Language language;

  void operator()(const Group&) { out << "group()"; }
  void operator()(const Union&) { out << "union()"; }
  void operator()(const Difference&) { out << "difference()"; }
  void operator()(const Intersection&) { out << "intersection()"; }
  void operator()(const Hull&) { out << "hull()"; }
  void operator()(const Fill&) { out << "fill()"; }
  void operator()(const Minkowski& op) {
    out << "minkowski(convexity = "
        << std::to_string(static_cast<unsigned>(op.convexity)) << ")";
  }
  void operator()(const Render& op) {
    out << "render(convexity = " << op.convexity << ")";
  }
  void operator()(const Transform& op) {
    out << "multmatrix([";
    for (int row = 0; row < 4; ++row) {
      const Vec4 values((*op.matrix)[0][row], (*op.matrix)[1][row],
                        (*op.matrix)[2][row], (*op.matrix)[3][row]);
      if (row > 0) out << ", ";
      // Signs of zeros depend on how a matrix is computed: none are shown.
      append_vector(values + 0.0, 4, language, out.text());
    }
    out << "])";
  }
  void operator()(const Color& op) {
    out << "color([" << op.rgba.x << ", " << op.rgba.y << ", " << op.rgba.z
        << ", " << op.rgba.w << "])";
  }
  void operator()(const Resize& op) {
    out << "resize(newsize = [" << op.new_size.x << "," << op.new_size.y << ","
        << op.new_size.z << "], auto = [";
    for (std::size_t i = 0; i < 3; ++i) {
      out << (i > 0 ? "," : "") << (op.auto_size[i] ? "1" : "0");
    }
    out << "], convexity = "
        << std::to_string(static_cast<unsigned>(op.convexity)) << ")";
  }
  void operator()(const Offset& op) {
    out << "offset(" << (op.is_delta ? "delta" : "r") << " = " << op.amount;
    if (op.is_delta) out << ", chamfer = " << op.chamfer;
    out << ", " << op.facets << ")";
  }
  void operator()(const Projection& op) {
    out << "projection(cut = " << op.cut << ", convexity = " << op.convexity
        << ")";
  }
  void operator()(const LinearExtrude& op) {
    out << "linear_extrude(";
    append_linear_extrude(*op.params, language, out.text());
    out << ")";
  }
  void operator()(const Roof& op) {
    out << "roof(method = \"" << (op.is_straight ? "straight" : "voronoi")
        << "\", " << op.facets << ", convexity = " << op.convexity << ")";
  }
  void operator()(const RotateExtrude& op) {
    out << "rotate_extrude(";
    append_rotate_extrude(op, language, out.text());
    out << ")";
  }
  void operator()(const Cube& op) {
    out << "cube(size = [" << op.size.x << ", " << op.size.y << ", "
        << op.size.z << "], center = " << op.center << ")";
  }
  void operator()(const Sphere& op) {
    out << "sphere(" << op.facets << ", r = " << op.r << ")";
  }
  void operator()(const Cylinder& op) {
    out << "cylinder(" << op.facets << ", h = " << op.h << ", r1 = " << op.r1
        << ", r2 = " << op.r2 << ", center = " << op.center << ")";
  }
  void operator()(const Polyhedron& polyhedron) {
    const PolyhedronParams& op = *polyhedron.params;
    out << "polyhedron(";
    if (!op.csg_text.empty()) {
      out << op.csg_text;
    } else {
      out << "points = ";
      append_points(op.points, 3, language, out.text());
      out << ", faces = ";
      append_indices(op.faces, out.text());
    }
    out << ", convexity = " << op.convexity << ")";
  }
  void operator()(const Square& op) {
    out << "square(size = [" << op.size.x << ", " << op.size.y
        << "], center = " << op.center << ")";
  }
  void operator()(const Circle& op) {
    out << "circle(" << op.facets << ", r = " << op.r << ")";
  }
  void operator()(const Polygon& polygon) {
    const PolygonParams& op = *polygon.params;
    out << "polygon(";
    if (!op.csg_text.empty()) {
      out << op.csg_text;
    } else {
      out << "points = ";
      append_points(op.points, 2, language, out.text());
      out << ", paths = ";
      if (op.paths) {
        append_indices(*op.paths, out.text());
      } else {
        out << "undef";
      }
    }
    out << ", convexity = " << op.convexity << ")";
  }
  void operator()(const Text& op) { out << op.params->csg_text; }
  void operator()(const Import& op) { out << op.params->csg_text; }
  void operator()(const Surface& op) { out << op.params->csg_text; }
};

// The `.csg` text of a node with all below it, where that is kept; else empty.
std::string_view whole_text(const Node& node) {
  if (const auto* linear = std::get_if<LinearExtrude>(&node.op)) {
    return linear->params->csg_text;
  }
  const auto* around = std::get_if<RotateExtrude>(&node.op);
  return around != nullptr ? around->csg_text : std::string_view();
}

void append_node(const Node& node, std::size_t depth, Language language,
                 std::string& text) {
  if (node.is_background) text += '%';
  if (node.is_highlight) text += '#';
  text.append(depth, '\t');
  const std::string_view whole = whole_text(node);
  if (whole.empty()) {
    std::visit(OpPrinter{Writer(text), language}, node.op);
  } else {
    text += whole;
  }
  if (node.children.empty() || !whole.empty()) {
    text += ";\n";
    return;
  }
  text += " {\n";
  for (const Node* child : node.children)
    append_node(*child, depth + 1, language, text);
  text.append(depth, '\t');
  text += "}\n";
}

}  // namespace

namespace {

// The vector of a top that is not above its bottom, as 2026 writes it.
void append_way(const LinearExtrudeParams& params, Writer& out) {
  const Vec3 way(params.shift, params.height);
  const double length = glm::length(way);
  out << "height = " << length;
  if (!(way.z < length)) return;
  out << ", v = [ " << way.x / length << ", " << way.y / length << ", "
      << way.z / length << "]";
}

// All that 2021.01 prints, and what only newer designs have.
void append_linear_2021(const LinearExtrudeParams& params, Writer& out) {
  append_way(params, out);
  out << ", center = " << params.center << ", convexity = " << params.convexity;
  if (params.has_twist) out << ", twist = " << params.twist_deg;
  if (params.slices > 0) out << ", slices = " << params.slices;
  if (params.segments) out << ", segments = " << *params.segments;
  out << ", scale = [" << params.scale.x << ", " << params.scale.y << "]";
  if (params.slices == 0) out << ", " << params.facets;
}

// What differs from a plain extrusion.
void append_linear_2026(const LinearExtrudeParams& params, Writer& out) {
  append_way(params, out);
  if (params.center) out << ", center = true";
  if (params.has_twist) out << ", twist = " << params.twist_deg;
  if (params.slices > 0) out << ", slices = " << params.slices;
  if (params.segments) out << ", segments = " << *params.segments;
  if (params.scale.x != params.scale.y) {
    out << ", scale = [" << params.scale.x << ", " << params.scale.y << "]";
  } else if (params.scale.x != 1) {
    out << ", scale = " << params.scale.x;
  }
  if (params.slices == 0 || !params.segments) out << ", " << params.facets;
  if (params.convexity > 1) out << ", convexity = " << params.convexity;
}

}  // namespace

void append_linear_extrude(const LinearExtrudeParams& params, Language language,
                           std::string& text) {
  Writer out(text);
  language == Language::k2021 ? append_linear_2021(params, out)
                              : append_linear_2026(params, out);
}

void append_rotate_extrude(const RotateExtrude& extrude, Language language,
                           std::string& text) {
  const double usual_start = extrude.angle_deg == 360 ? 180 : 0;
  Writer out(text);
  out << "angle = " << extrude.angle_deg;
  if (language != Language::k2021 || extrude.start_deg != usual_start) {
    out << ", start = " << extrude.start_deg;
  }
  out << ", convexity = " << extrude.convexity << ", " << extrude.facets;
}

std::string print_csg(const Tree& tree, const Node& root) {
  std::string text;
  if (&root == tree.root) {
    for (const Node* child : root.children)
      append_node(*child, 0, tree.language, text);
  } else {
    append_node(root, 0, tree.language, text);
  }
  return text + "\n";
}

}  // namespace lamina::csg
