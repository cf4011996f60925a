#pragma once
// The walk that lowers a tree, one overload for each kind of node.
//
// Cut by what a node is: lower_operators.cpp has the operators and how
// operands of two and three dimensions meet, lower_leaves.cpp the solids that
// stand at the bottom, lower_planar.cpp what lies in the plane, lower_files.cpp
// what is read from files, lower_boundary.cpp the operators that need the
// explicit boundary of their subtree (hull, resize, projection), and
// lower_minkowski.cpp the sum.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "csg/import/mesh_file.h"
#include "csg/lower/detail/fineness.h"
#include "csg/lower/detail/leaf_store.h"
#include "csg/lower/detail/program_builder.h"
#include "csg/lower/lower.h"
#include "csg/scene.h"
#include "csg/tree.h"
#include "plane/region/region.h"

namespace lamina::csg {

// What a subtree is. A solid's parts lie on the program builder's stack.
// There may be none: an empty solid is three-dimensional all the same.
enum class Dimension { kNone, kFlat, kSolid };
struct Shape {
  Dimension dimension = Dimension::kNone;
  plane::Region region = {};
  // Whether OpenSCAD would have evaluated a Boolean for a solid, where else it
  // holds one list of faces. Scaled by 0, the result of a Boolean is
  // removed, and a list of faces becomes flat.
  bool is_boolean = false;
  // The operands that follow `region`, where the operator above takes them for
  // its own (Place::joins).
  std::vector<plane::Region> more_regions = {};
};

struct Operand;

// A node, and the matrix that its operators above make of its coordinates.
struct Place {
  const Node& node;
  const Affine& world;
  // The operator above that takes the operands of the node for its own, where
  // the node is such an operator, too.
  std::optional<plane::BooleanOp> joins = std::nullopt;
};

// What only unites its children.
template <typename Op>
concept Grouping = std::same_as<Op, Group> || std::same_as<Op, Union> ||
    std::same_as<Op, Render>;

// What is made once for the whole design, though parts of it are lowered apart.
struct SharedTables {
  HullTable hulls;
  std::map<std::string, Leaf> decimated;  // by file, arguments and tolerance
  // Of resize(): how far each makes its subtree larger, as far as is known. Its
  // facets are finer by that; the factor depends on the facets in turn, so the
  // outermost resize() has all below lowered until none grows any more.
  std::map<const Node*, Vec3> growths;
  bool is_resizing = false;
  bool has_grown = false;
  std::set<const Node*> empty;        // of resizes, in this lowering
  std::set<const Node*> known_empty;  // with far finer facets, too
};

class Lowerer {
 public:
  // instances  about as many as there will be
  // shared     of the whole design; they outlive the lowerer
  Lowerer(std::size_t instances, const LowerOptions& options,
          SharedTables& shared, Diagnostics& diagnostics);

  // The solid parts of the subtree are left on top of the builder's stack, in
  // world coordinates; a region is in the node's own coordinates.
  // Throws GeometryError where something has to be clipped beyond 1e9 mm.
  Shape lower(const Place& at);

  Scene take_scene();
  // Returns the scene without flat parts.
  Scene take_solids();

 private:
  Shape lower_node(const Place& at);
  // Whether the node, and all below it, is one thing that keeps its size:
  // the outermost with $rigid that does not only place what is below it.
  bool begins_rigid(const Node& node) const;
  Shape lower_rigid(const Place& at);

  // --- lower_operators.cpp --------------------------------------------------
  template <Grouping Op>
  Shape lower_op(const Op&, const Place& at) {
    return lower_children(at, plane::BooleanOp::kUnion);
  }
  Shape lower_op(const Difference&, const Place& at) {
    return lower_children(at, plane::BooleanOp::kDifference);
  }
  Shape lower_op(const Intersection&, const Place& at) {
    return lower_children(at, plane::BooleanOp::kIntersection);
  }
  Shape lower_op(const Transform& op, const Place& at);
  Shape lower_op(const Color& op, const Place& at);

  // Treats the parts above the mark, of this shape, as a singular matrix that
  // placed them asks for.
  void flatten(std::size_t mark, const Shape& shape, SourceRange range);

  // The operands of an operator: those of the first child's dimension.
  struct Operands {
    Dimension dimension = Dimension::kNone;
    std::size_t count = 0;
    std::vector<std::size_t> begins;  // on the stack; not kept for a union
    std::vector<plane::Region> regions;
    std::vector<const Node*> strays;  // of the other dimension
    const Node* first_mixed = nullptr;
    std::size_t solid_count = 0;  // of those that are not empty
    bool has_boolean = false;     // among these
    bool is_first_none = false;   // of the first one's dimension
    bool is_later_empty = false;  // of solids: any but the first
  };
  // All children; `dimension` decides unless it is kNone. Without an operator
  // each is kept, and has one region at most.
  Operands lower_operands(const Place& at, std::optional<plane::BooleanOp> op,
                          Dimension dimension);
  void add_operand(const Place& child, bool is_union, Operands& operands);
  static bool is_boolean(plane::BooleanOp op, const Operands& operands);
  // Whether OpenSCAD makes nothing of solids, be it empty, rather than an empty
  // solid: then the operator's siblings may be flat.
  static bool is_nothing(plane::BooleanOp op, const Operands& operands);
  void report_strays(const Operands& operands);
  Shape lower_children(const Place& at, plane::BooleanOp op);

  // Leaves a scene that was lowered apart on top of the stack, as the parts of
  // its program.
  void place_scene(const Scene& scene, const Affine& world);

  // --- lower_leaves.cpp -----------------------------------------------------
  Shape lower_op(const Cube& cube, const Place& at);
  Shape lower_op(const Sphere& sphere, const Place& at);
  Shape lower_op(const Cylinder& c, const Place& at);
  Shape lower_op(const Polyhedron& polyhedron, const Place& at);
  Shape lower_op(const LinearExtrude& op, const Place& at);
  Shape lower_op(const RotateExtrude& op, const Place& at);
  Shape lower_op(const Roof& op, const Place& at);

  // For a node with these $fn, $fa, $fs.
  Fineness fineness(const Facets& facets, const Affine& world) const;
  // flatten_children with a share of the chordal error, for an outline whose
  // parts become larger by `growth`.
  Shape flatten_finely(const Place& at, double share, double growth = 1);

  void place_leaf(Leaf leaf, const Place& at);
  // Nothing for a leaf without a surface.
  std::optional<std::uint32_t> add_leaf(Leaf leaf);
  void place(std::uint32_t leaf, Vec3 size, const Place& at);
  Box3 bound(std::uint32_t leaf, const Affine& m);

  // --- lower_planar.cpp -----------------------------------------------------
  Shape lower_op(const Square& op, const Place& at);
  Shape lower_op(const Circle& op, const Place& at);
  Shape lower_op(const Polygon& op, const Place& at);
  Shape lower_op(const Offset& op, const Place& at);
  Shape lower_op(const Fill& op, const Place& at);
  Shape lower_op(const Text& op, const Place& at);

  // The children's union in the plane, whatever else there is.
  Shape flatten_children(const Place& at);

  // --- lower_files.cpp ------------------------------------------------------
  // A solid or a region: its file says.
  Shape lower_op(const Import& op, const Place& at);
  Shape lower_op(const Surface& op, const Place& at);

  // What a file holds. It is read once, however often the design names it.
  struct FileShape {
    Dimension dimension = Dimension::kNone;
    plane::Region region = {};
    std::optional<std::uint32_t> leaf = std::nullopt;
  };
  // The tolerance of --decimate in a node's own coordinates; 0: none.
  double decimation_at(const Affine& world) const;
  // The chordal error of files of CAD programs where none is asked for.
  double chordal_error_of_parts_at(const Affine& world) const;
  // In the file's lengths; 0: none.
  double decimation_of(const ImportParams& params, const Affine& world) const;
  FileShape read_import(const ImportParams& params, const Fineness& fine,
                        double decimation, const Node& node);
  // The bodies of a file of meshes or, with this error, of a CAD program.
  std::vector<RawMesh> read_bodies(const ImportParams& params,
                                   double chordal_error, const Node& node);
  Shape place_file(const FileShape& shape, const Place& at);
  // --- lower_boundary.cpp ---------------------------------------------------
  Shape lower_op(const Hull& op, const Place& at);
  Shape lower_op(const Resize& op, const Place& at);
  Shape lower_op(const Projection& op, const Place& at);

  // A node's children lowered by themselves, in the node's coordinates.
  struct Apart {
    Dimension dimension = Dimension::kNone;
    std::vector<plane::Region> regions;  // of their union
    Scene scene;                         // their union
    bool is_boolean = false;             // as Shape's
    std::size_t count = 0;               // of the children
  };
  Apart lower_apart(const Place& at, bool takes_corners = false);
  // A lowerer for those children; nothing lowered yet.
  Lowerer make_inner(const Place& at);
  // What is resized, not scaled yet: one region, or a scene.
  struct Resized {
    Apart apart;
    std::optional<Vec3> factor;  // none of what is empty
  };
  // With facets finer by the growth known so far; notes it where it is greater.
  Resized resize(const Resize& op, const Place& at);
  // Of an outermost resize(): notes how far all below it grow, from drafts.
  void draft_sizes(const Resize& op, const Place& at);
  // Of an outermost resize(): with facets that are fine enough.
  Resized resize_finely(const Resize& op, const Place& at);

  // --- lower_minkowski.cpp --------------------------------------------------
  Shape lower_op(const Minkowski& op, const Place& at);
  std::vector<Scene> take_scenes(const std::vector<std::size_t>& begins);
  // The sum of all of them, in node's coordinates. At least one.
  Operand add_terms(std::vector<Operand> terms, const Node& node);
  void place_sum(const Operand& sum, const Place& at);

  struct KeptBox {
    std::uint32_t leaf = 0;
    Affine linear{0.0};
    Box3 box;
  };

  LowerOptions options_;
  SharedTables& shared_;
  Diagnostics& diagnostics_;
  // Only the corners of the next leaf count: it is below a hull, without
  // siblings all the way. So its faces need not be closed.
  bool takes_corners_ = false;
  bool is_rigid_ = false;          // below a node that keeps its size
  bool is_apart_ = false;          // in coordinates that are scaled later
  std::int32_t color_ = kNoColor;  // of the outermost color() above
  LeafStore leaves_;
  ProgramBuilder builder_;
  std::array<KeptBox, 64> kept_boxes_;
  std::map<std::string, FileShape> file_shapes_;  // by path and csg_text
};

// Applies the part of the matrix that acts in the plane. Outer contours stay
// counter-clockwise.
plane::Region transform_region(plane::Region region, const Mat4& matrix,
                               SourceRange range, Diagnostics& diagnostics);

// Reports the first malformed point; returns whether there is none.
//
// type  "vec2" or "vec3"
bool check_points(std::string_view wrong_point, std::string_view type,
                  SourceRange range, Diagnostics& diagnostics);

// index  as OpenSCAD shows it
// list   "faces" or "paths"
void warn_of_index(std::uint64_t index, std::string_view list, std::size_t i,
                   std::size_t k, SourceRange range, Diagnostics& diagnostics);

// Throws GeometryError, with the node's chain of calls.
[[noreturn]] void fail_unsupported(const Node& node, std::string_view module);

}  // namespace lamina::csg
