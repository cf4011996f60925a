#pragma once
// The CSG tree: what evaluating a program gives.
//
// Nodes are modules with evaluated parameters, exactly those that OpenSCAD's
// `.csg` text shows, so that printing the tree is the same as exporting it.
// Nodes, lists and texts live in the tree's arena; parameters too large for a
// node stand behind a pointer into it. Every node keeps the text that made it
// and the chain of calls that led there.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/arena.h"
#include "base/source.h"
#include "base/vec.h"
#include "parser/language.h"

namespace lamina::csg {

// One step of a call chain, innermost first; shared by all nodes below it.
struct CallSite {
  const CallSite* caller = nullptr;  // null: the top level
  std::string_view name;             // of the module called
  SourceRange range;                 // of the call
};

// How `$support` asks for supports below a leaf: the diameter of their tips
// [mm], 0 for none, NaN where it means nothing, and this where it is not set.
inline constexpr float kNoSupportTip = -1;

// $fn, $fa, $fs, $fe as in force where the module was called.
struct Facets {
  double fn = 0;
  double fa = 12;
  double fs = 2;
  double fe = 0;  // 0 in 2021, to which the name means nothing
};

// --- Operations -----------------------------------------------------------
// Groups are unions; the name is what `.csg` prints ("group", "union").
struct Group {
  bool is_call = false;  // of a module of the design: it makes one thing
};
struct Union {};
struct Difference {};
struct Intersection {};
struct Hull {};
struct Fill {};
struct Minkowski {
  int convexity = 0;
};
struct Render {
  int convexity = 0;
};
struct Transform {
  const Mat4* matrix;
};  // row-vector free: p' = matrix * p
struct Color {
  Vec4 rgba;
};
struct Resize {
  Vec3 new_size;
  std::array<bool, 3> auto_size;
  int convexity = 0;
};
struct Offset {
  double amount = 0;
  bool is_delta = false;  // else a radius: round joins
  bool chamfer = false;
  Facets facets = {};
};
struct Projection {
  bool cut = false;
  int convexity = 0;
};
struct LinearExtrudeParams {
  double height = 100;   // along z
  Vec2 shift = Vec2(0);  // of the top, in x and y
  bool center = false;
  int convexity = 1;
  double twist_deg = 0;
  bool has_twist = false;
  int slices = 0;  // 0: not given; csg/facets.h has the rules
  // For each contour; 0: edges stay whole. Not given: the language decides.
  std::optional<int> segments = {};
  Vec2 scale = Vec2(1);
  Facets facets = {};
  // With the deprecated file=: what `.csg` prints, whole. The import that is
  // the only child then does not show.
  std::string_view csg_text = {};
};
struct LinearExtrude {
  const LinearExtrudeParams* params;
};
struct RotateExtrude {
  double angle_deg = 360;
  int convexity = 2;
  Facets facets = {};
  double start_deg = 0;
  std::string_view csg_text = {};  // as for LinearExtrude
};
// A solid over what its children are in the plane, with faces at 45°.
struct Roof {
  bool is_straight = false;  // else "voronoi": round at reflex corners
  int convexity = 1;
  Facets facets = {};
};

// --- Leaves ---------------------------------------------------------------
struct Cube {
  Vec3 size = Vec3(1);
  bool center = false;
};
struct Sphere {
  double r = 1;
  Facets facets = {};
};
struct Cylinder {
  double h = 1;
  double r1 = 1;
  double r2 = 1;
  bool center = false;
  Facets facets = {};
};
struct PolyhedronParams {
  std::span<const Vec3> points;
  std::span<const std::span<const std::uint32_t>> faces;
  int convexity = 1;
  // "points = …, faces = …" as written, where that is not just the numbers
  // above (points of two numbers, undef, …); else empty.
  std::string_view csg_text = {};
  // "points[3] = [0, \"a\"]", the first malformed point of a face; else
  // empty. Such points may be [0, 0, 0], or not finite.
  std::string_view wrong_point = {};
};
struct Polyhedron {
  const PolyhedronParams* params;
};
struct Square {
  Vec2 size = Vec2(1);
  bool center = false;
};
struct Circle {
  double r = 1;
  Facets facets = {};
};
struct PolygonParams {
  std::span<const Vec2> points;
  // No value: one path through all points in order.
  std::optional<std::span<const std::span<const std::uint32_t>>> paths;
  int convexity = 1;
  std::string_view csg_text = {};     // as for Polyhedron
  std::string_view wrong_point = {};  // likewise, of any point
};
struct Polygon {
  const PolygonParams* params;
};
// What comes from fonts and files keeps, beside its parameters, the text that
// `.csg` prints for it (`text(text = "a", …)`), whole: paths and time stamps
// are in it as OpenSCAD shows them.
struct TextParams {
  std::string_view text;  // UTF-8
  double size = 10;
  double spacing = 1;
  std::string_view font;       // as fontconfig reads it; empty: the default
  std::string_view direction;  // "ltr", "rtl", "ttb", "btt"
  std::string_view language;
  std::string_view script;  // ISO 15924; empty: none
  std::string_view halign;  // as given, valid or not
  std::string_view valign;
  Facets facets = {};
  Language rules = Language::k2021;  // by which glyphs are placed
  std::string_view csg_text;
};
struct Text {
  const TextParams* params;
};
// Parts of CAD programs get it where no chordal error is asked for: that of a
// circle of 20 mm with 100 sides [mm].
inline constexpr double kChordalErrorOfParts = 0.01;

enum class ImportFormat : std::uint8_t {
  kUnknown,
  kStl,
  kOff,
  kObj,
  kPly,
  kAmf,
  k3mf,
  kDxf,
  kSvg,
  kStep,
  kIges,
  kBrep,
  kFcstd  // the boundary of one object
};
struct ImportParams {
  std::string_view path;  // to open
  ImportFormat format = ImportFormat::kUnknown;
  Language rules = Language::k2021;  // by which the file is read
  // The file is the design: a 3MF or AMF is read as slicers read it, with its
  // items where they are placed, and in its unit.
  bool is_design = false;
  std::optional<std::string_view> id = std::nullopt;  // SVG; elsewhere the part
  std::optional<std::string_view> layer = std::nullopt;
  std::string_view entry;     // of a FreeCAD file: where a boundary is
  std::string_view boundary;  // and its bytes: the file is read once
  Vec2 origin = Vec2(0);
  bool center = false;
  double dpi = 72;
  double scale = 1;
  // Greatest distance of a decimated mesh from that of the file, in its own
  // lengths; 0: the file's mesh; none: the run decides.
  std::optional<double> decimate = std::nullopt;
  int convexity = 1;
  Facets facets = {};
  std::string_view csg_text;
};
struct Import {
  const ImportParams* params;
};
struct SurfaceParams {
  std::string_view path;             // to open
  Language rules = Language::k2021;  // by which the file is read
  bool center = false;
  bool invert = false;
  int convexity = 1;
  std::string_view csg_text;
};
struct Surface {
  const SurfaceParams* params;
};

struct Node {
  std::variant<Group, Union, Difference, Intersection, Hull, Fill, Minkowski,
               Render, Transform, Color, Resize, Offset, Projection,
               LinearExtrude, RotateExtrude, Roof, Cube, Sphere, Cylinder,
               Polyhedron, Square, Circle, Polygon, Text, Import, Surface>
      op;
  std::span<const Node* const> children;
  SourceRange range;
  const CallSite* caller = nullptr;
  float support_tip = kNoSupportTip;  // $support
  bool is_visible = false;            // $visible
  bool is_rigid = false;              // $rigid
  bool is_root = false;               // !
  bool is_highlight = false;          // #
  bool is_background = false;         // %
};

// Owns its nodes. The root is a Group ("group", the implicit top level).
struct Tree {
  std::shared_ptr<Arena> arena;
  // Has the call sites: a scene goes on pointing at them.
  std::shared_ptr<Arena> calls;
  const Node* root = nullptr;
  // Decides how round shapes and extrusions are divided, and how `.csg` text
  // shows them.
  Language language = Language::k2021;
  // Paths that modules and functions named as files to read, whether they are
  // there or not; in the order of evaluation, each once.
  std::vector<std::string> files = {};
  // Where the evaluation ended, as what ran was not written for 2021.01
  // (EvaluateOptions::finds_language).
  std::optional<NewerSyntax> newer = {};
  // The first place, known to be one, at which the other language takes another
  // value.
  std::optional<NewerSyntax> difference = {};

  // Gives the memory of all nodes back; call chains stay.
  void drop_nodes() {
    root = nullptr;
    arena.reset();
  }
};

}  // namespace lamina::csg
