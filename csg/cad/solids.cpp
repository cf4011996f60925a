#include "csg/cad/detail/solids.h"

#include <algorithm>

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Tool.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeFix_Solid.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <fmt/format.h>

namespace lamina::cad {
namespace {

// Edges of faces that belong together and that a file gives twice lie within
// what its program takes for one point; most take 1e-7 to 1e-3 mm.
constexpr double kSewingTolerances[] = {1e-6, 1e-4, 1e-3, 1e-2};

bool has_open_shell(const TopoDS_Shape& shape) {
  for (TopExp_Explorer at(shape, TopAbs_SHELL); at.More(); at.Next()) {
    if (!BRep_Tool::IsClosed(at.Current())) return true;
  }
  return false;
}

// The faces as shells, with edges joined that are not farther apart than it
// takes, and never more than the chordal error.
TopoDS_Shape sew(const std::vector<TopoDS_Shape>& faces, double chordal_error) {
  TopoDS_Shape sewn;
  for (const double tolerance : kSewingTolerances) {
    if (!sewn.IsNull() && tolerance > chordal_error) break;
    BRepBuilderAPI_Sewing sewing(tolerance);
    for (const TopoDS_Shape& face : faces) sewing.Add(face);
    sewing.Perform();
    sewn = sewing.SewedShape();
    if (sewing.NbFreeEdges() == 0) break;
  }
  return sewn;
}

// A closed shell as the solid within it, whichever way its faces look.
TopoDS_Shape fill(const TopoDS_Shape& shell) {
  if (!BRep_Tool::IsClosed(shell)) return shell;
  ShapeFix_Solid fix;
  return fix.SolidFromShell(TopoDS::Shell(shell));
}

void add_faces(const TopoDS_Shape& shape, TopAbs_ShapeEnum outside,
               std::vector<TopoDS_Shape>& faces) {
  for (TopExp_Explorer at(shape, TopAbs_FACE, outside); at.More(); at.Next()) {
    faces.push_back(at.Current());
  }
}

// Solids and shells of sewn faces. A face that stays alone is a shell, too.
void add_sewn(const std::vector<TopoDS_Shape>& faces, const std::string& name,
              double chordal_error, std::vector<Solid>& solids,
              std::vector<std::string>& warnings) {
  if (faces.empty()) return;
  const TopoDS_Shape sewn = sew(faces, chordal_error);
  std::size_t open = 0;
  for (TopExp_Explorer at(sewn, TopAbs_SHELL); at.More(); at.Next()) {
    const TopoDS_Shape filled = fill(at.Current());
    if (filled.ShapeType() == TopAbs_SHELL) ++open;
    solids.push_back({filled, name});
  }
  for (TopExp_Explorer at(sewn, TopAbs_FACE, TopAbs_SHELL); at.More();
       at.Next()) {
    ++open;
    solids.push_back({at.Current(), name});
  }
  if (open > 0) {
    warnings.push_back(fmt::format("{}{} of {} shells are open",
                                   prefix_of(name), open, solids.size()));
  }
}

TopoDS_Shape healed(const TopoDS_Shape& shape) {
  ShapeFix_Shape fix(shape);
  fix.Perform();
  return fix.Shape();
}

std::size_t count(const TopoDS_Shape& shape, TopAbs_ShapeEnum what,
                  TopAbs_ShapeEnum outside) {
  std::size_t count = 0;
  for (TopExp_Explorer at(shape, what, outside); at.More(); at.Next()) ++count;
  return count;
}

}  // namespace

std::vector<Solid> find_solids(const ShapeFile& file, double chordal_error,
                               std::vector<std::string>& warnings) {
  std::vector<Solid> solids;
  for (TopExp_Explorer at(file.shape, TopAbs_SOLID); at.More(); at.Next()) {
    const int* const name =
        file.name_of_solid.Seek(at.Current().Located(TopLoc_Location()));
    Solid solid{at.Current(),
                name == nullptr ? std::string()
                                : file.names[static_cast<std::size_t>(*name)]};
    if (has_open_shell(solid.shape)) solid.shape = healed(solid.shape);
    if (!has_open_shell(solid.shape)) {
      solids.push_back(std::move(solid));
      continue;
    }
    std::vector<TopoDS_Shape> faces;
    add_faces(solid.shape, TopAbs_SHAPE, faces);
    add_sewn(faces, solid.name, chordal_error, solids, warnings);
  }
  std::vector<TopoDS_Shape> faces;
  add_faces(file.shape, TopAbs_SOLID, faces);
  add_sewn(faces, "", chordal_error, solids, warnings);
  const std::size_t wires = count(file.shape, TopAbs_EDGE, TopAbs_FACE);
  if (wires > 0) {
    warnings.push_back(
        fmt::format("{} edges without a face are left out", wires));
  }
  return solids;
}

std::string prefix_of(const std::string& name) {
  return name.empty() ? "" : fmt::format("'{}': ", name);
}

}  // namespace lamina::cad
