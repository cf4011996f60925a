#include "csg/cad/detail/solids.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_Solid.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <fmt/format.h>

namespace lamina::cad {
namespace {

using Shapes = std::vector<TopoDS_Shape>;

Shapes parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum what,
                TopAbs_ShapeEnum outside = TopAbs_SHAPE) {
  Shapes parts;
  for (TopExp_Explorer at(shape, what, outside); at.More(); at.Next()) {
    parts.push_back(at.Current());
  }
  return parts;
}

bool is_closed(const TopoDS_Shape& shell) { return BRep_Tool::IsClosed(shell); }

bool has_open_shell(const TopoDS_Shape& shape) {
  return !std::ranges::all_of(parts_of(shape, TopAbs_SHELL), is_closed);
}

// --- Faces to shells ---------------------------------------------------------

// Joins the edges of faces that are not farther apart than it takes, and never
// than the chordal error. Edges that belong together and that a file gives
// twice lie within what its program takes for one point, 1e-7 to 1e-3 mm.
TopoDS_Shape sew(const Shapes& faces, double chordal_error) {
  TopoDS_Shape sewn;
  for (const double tolerance : {1e-6, 1e-4, 1e-3, 1e-2}) {
    if (!sewn.IsNull() && tolerance > chordal_error) break;
    BRepBuilderAPI_Sewing sewing(tolerance);
    for (const TopoDS_Shape& face : faces) sewing.Add(face);
    sewing.Perform();
    sewn = sewing.SewedShape();
    if (sewing.NbFreeEdges() == 0) break;
  }
  return sewn;
}

// A face that closes by itself, such as a sphere's, stays alone.
TopoDS_Shell shell_of(const TopoDS_Shape& face) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  return shell;
}

Shapes shells_of(const TopoDS_Shape& sewn) {
  Shapes shells = parts_of(sewn, TopAbs_SHELL);
  for (const TopoDS_Shape& face : parts_of(sewn, TopAbs_FACE, TopAbs_SHELL)) {
    shells.push_back(shell_of(face));
  }
  return shells;
}

// --- Shells to solids --------------------------------------------------------

// A closed shell, as what is inside of it.
struct Filled {
  TopoDS_Shape shell;
  TopoDS_Solid solid;
  double volume = 0;  // less than 0 where the file's faces look inward
  std::vector<const Filled*> voids = {};
  bool is_void = false;
};

Filled fill(const TopoDS_Shape& shell) {
  GProp_GProps measures;
  BRepGProp::VolumeProperties(shell, measures);
  ShapeFix_Solid fix;
  return {shell, fix.SolidFromShell(TopoDS::Shell(shell)), measures.Mass()};
}

bool look_alike(const Filled& a, const Filled& b) {
  return (a.volume < 0) == (b.volume < 0);
}

// Whether nothing of the inner one is outside, nor is it a copy. A vertex
// outside says no at once, also where OpenCASCADE fails to cut because edges
// lie in each other; else what crosses has all vertices inside, too, so it
// cuts.
bool contains(const Filled& outer, const Filled& inner) {
  constexpr double kLeastShare = 1e-6;  // of a volume: exactness of Mass()
  if (std::abs(inner.volume) > (1 - kLeastShare) * std::abs(outer.volume)) {
    return false;
  }
  BRepClass3d_SolidClassifier classifier(outer.solid);
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(inner.shell, TopAbs_VERTEX, vertices);
  if (vertices.IsEmpty()) return false;
  for (int i = 1; i <= vertices.Extent(); ++i) {
    classifier.Perform(BRep_Tool::Pnt(TopoDS::Vertex(vertices(i))),
                       Precision::Confusion());
    if (classifier.State() == TopAbs_OUT) return false;
  }
  BRepAlgoAPI_Cut outside(inner.solid, outer.solid);
  return !outside.HasErrors() &&
         parts_of(outside.Shape(), TopAbs_SOLID).empty();
}

// A shell that lies in another one and looks the other way bounds a void of it,
// unless another void is around it. All others are solids of their own, also
// those that cross.
void add_solids(std::vector<Filled>& all, const std::string& name,
                std::vector<Solid>& solids) {
  std::vector<Filled*> by_size;
  for (Filled& one : all) by_size.push_back(&one);
  std::stable_sort(by_size.begin(), by_size.end(), [](auto* a, auto* b) {
    return std::abs(a->volume) > std::abs(b->volume);
  });
  std::vector<Filled*> outer;
  for (Filled* one : by_size) {
    for (Filled* other : outer) {
      if (look_alike(*other, *one) || !contains(*other, *one)) continue;
      const auto is_around = [&](const Filled* hollow) {
        return contains(*hollow, *one);
      };
      if (std::ranges::any_of(other->voids, is_around)) continue;
      other->voids.push_back(one);
      one->is_void = true;
    }
    if (!one->is_void) outer.push_back(one);
  }
  const BRep_Builder builder;
  for (const Filled& one : all) {
    if (one.is_void) continue;
    TopoDS_Solid solid = one.solid;
    for (const Filled* hollow : one.voids) {
      const TopoDS_Shape turned = hollow->solid.Reversed();
      for (const TopoDS_Shape& shell : parts_of(turned, TopAbs_SHELL)) {
        builder.Add(solid, shell);
      }
    }
    solids.push_back({solid, name});
  }
}

// The shells of a file that close by themselves, and what the faces of all
// others are sewn to. Sewn together, two closed ones that share a part of an
// edge would be torn.
//
// outside  shells of such shapes do not count
Shapes sewn_shells(const TopoDS_Shape& shape, TopAbs_ShapeEnum outside,
                   double chordal_error) {
  Shapes shells;
  Shapes faces = parts_of(shape, TopAbs_FACE, TopAbs_SHELL);
  for (const TopoDS_Shape& shell : parts_of(shape, TopAbs_SHELL, outside)) {
    const Shapes own = parts_of(shell, TopAbs_FACE);
    const Shapes joined = shells_of(sew(own, chordal_error));
    if (std::ranges::all_of(joined, is_closed)) {
      shells.insert(shells.end(), joined.begin(), joined.end());
    } else {
      faces.insert(faces.end(), own.begin(), own.end());
    }
  }
  if (faces.empty()) return shells;
  for (const TopoDS_Shape& shell : shells_of(sew(faces, chordal_error))) {
    shells.push_back(shell);
  }
  return shells;
}

void add_sewn(const Shapes& shells, const std::string& name,
              std::vector<Solid>& solids, std::vector<std::string>& warnings) {
  std::vector<Filled> filled;
  std::size_t open = 0;
  for (const TopoDS_Shape& shell : shells) {
    if (is_closed(shell)) {
      filled.push_back(fill(shell));
    } else {
      ++open;
      solids.push_back({shell, name});
    }
  }
  add_solids(filled, name, solids);
  if (open > 0) {
    warnings.push_back(fmt::format("{}{} of {} shells are open",
                                   prefix_of(name), open, shells.size()));
  }
}

TopoDS_Shape healed(const TopoDS_Shape& shape) {
  ShapeFix_Shape fix(shape);
  fix.Perform();
  return fix.Shape();
}

std::string name_of(const TopoDS_Shape& solid, const ShapeFile& file) {
  const int* const name =
      file.name_of_solid.Seek(solid.Located(TopLoc_Location()));
  return name == nullptr ? "" : file.names[static_cast<std::size_t>(*name)];
}

}  // namespace

std::vector<Solid> find_solids(const ShapeFile& file, double chordal_error,
                               Part& part) {
  std::vector<Solid> solids;
  for (const TopoDS_Shape& found : parts_of(file.shape, TopAbs_SOLID)) {
    const std::string name = name_of(found, file);
    const TopoDS_Shape solid = has_open_shell(found) ? healed(found) : found;
    if (has_open_shell(solid)) {
      add_sewn(sewn_shells(solid, TopAbs_SHAPE, chordal_error), name, solids,
               part.warnings);
    } else {
      solids.push_back({solid, name});
    }
  }
  add_sewn(sewn_shells(file.shape, TopAbs_SOLID, chordal_error), "", solids,
           part.warnings);
  const Shapes wires = parts_of(file.shape, TopAbs_EDGE, TopAbs_FACE);
  if (!wires.empty()) {
    part.notes.push_back(
        fmt::format("{} edges without a face are left out", wires.size()));
  }
  return solids;
}

std::string prefix_of(const std::string& name) {
  return name.empty() ? "" : fmt::format("'{}': ", name);
}

}  // namespace lamina::cad
