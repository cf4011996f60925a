#pragma once
// How far chords and triangles are from the curves and surfaces that they stand
// for.

#include <BRepAdaptor_Surface.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>
#include <gp_XY.hxx>

namespace lamina::cad {

// The greatest distance of points of edges from their chords [mm]. The shape is
// meshed.
double deviation_of_edges(const TopoDS_Shape& shape);

// A face's surface, asked for distances.
class Surface {
 public:
  explicit Surface(const TopoDS_Face& face);

  bool is_plane() const { return adaptor_.GetType() == GeomAbs_Plane; }
  gp_Pnt at(gp_XY uv) const { return adaptor_.Value(uv.X(), uv.Y()); }

  // The distance of p, or any that is at most `enough`: that of the point at
  // (u, v), which need not be the nearest, and where it is too far that of
  // nearer ones.
  double distance(const gp_Pnt& p, gp_XY uv, double enough);

 private:
  double searched_distance(const gp_Pnt& p);

  TopoDS_Face face_;
  BRepAdaptor_Surface adaptor_;
  Handle(ShapeAnalysis_Surface) search_;
};

}  // namespace lamina::cad
