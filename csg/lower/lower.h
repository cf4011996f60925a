#pragma once
// From the CSG tree to the scene.
//
// Transforms are pushed down to the leaves, colours and groups vanish, 2D
// subtrees become regions and then extrusions (of operators that one operator
// can stand for, operands of like size are combined at once), and what remains
// is a flat Boolean program over instances of few shared leaves. Parts that are
// provably empty are left out. What is 2D, 3D, empty or mixed follows OpenSCAD
// 2021.01, warnings included.

#include <string>
#include <variant>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/scene.h"
#include "csg/tree.h"
#include "plane/region/region.h"

namespace lamina::cad {
class Reader;
}
namespace lamina::text {
class Typesetter;
}

namespace lamina::csg {

struct LowerOptions {
  // Multiplies every instance's matrix from the left (`--axis`); orthogonal.
  // Outlines stay as they are.
  Affine world_from_design{1.0};
  // Greatest distance in the world of facets from the round surface that they
  // stand for, where $fn is 0 [mm]; 0: $fa and $fs decide instead.
  double chordal_error = 0;
  // That distance for files of CAD programs, which have no $fn, where it is 0;
  // lower() sets it to 0 where the tree names none.
  double chordal_error_of_parts = kChordalErrorOfParts;
  // The share of that error which a part's mesh may lie below its hull, which
  // then stands for it. minkowski() sets it, for the sake of its cost.
  double hull_share = 0;
  // Greatest distance in the world of decimated meshes from those that import()
  // read, where it does not say itself [mm]; 0: meshes stay as they are.
  double decimation = 0;
  // Where modules are looked for (base/file/module.h).
  std::vector<std::string> module_folders = {};
  // Sets text(), which is an error without it.
  text::Typesetter* typesetter = nullptr;
  // Reads STEP, IGES and BREP, which are errors without it.
  cad::Reader* cad_reader = nullptr;
  const FileAccess* file_access = &kAllFiles;  // what import() may read
  // Scales the whole design about its origin, outlines too (`--scale`): along
  // x, y and z of the world, positive. Facets are those of the design before.
  // What a node with $rigid makes is moved and keeps its size.
  Vec3 scale = Vec3(1);
  Language language = Language::k2021;  // lower() sets it to the tree's
};

// A design is nothing, an outline in the plane, or a solid.
struct Lowered {
  std::variant<std::monostate, plane::Region, Scene> geometry;

  bool is_empty() const { return geometry.index() == 0; }
  const plane::Region* outline() const {
    return std::get_if<plane::Region>(&geometry);
  }
  const Scene* scene() const { return std::get_if<Scene>(&geometry); }
};

// Lowers the whole tree, or the subtree of the `!` modifier. Recurses as deep
// as the tree is nested. Time and memory are linear in the tree.
//
// throws  GeometryError where the solid, or a polygon or face that has to be
//         clipped on the way, reaches beyond 1e9 mm, and where the tree asks
//         for more than csg/limits.h allows
//
// The scene points to the tree's call sites and to nothing else in it.
Lowered lower(const Tree& tree, const LowerOptions& options,
              Diagnostics& diagnostics);

}  // namespace lamina::csg
