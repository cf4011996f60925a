#pragma once
// How far chords and triangles are from the curves and surfaces that they stand
// for.

#include <BRepAdaptor_Surface.hxx>
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

  // The distance of p from the nearest point that a few steps find from (u, v)
  // on, or from any that is at most `enough` away. So it is never too small.
  //
  // OpenCASCADE's search over the whole surface costs a thousand times as much,
  // and finds no nearer point where (u, v) are the parameters of a triangle.
  double distance(const gp_Pnt& p, gp_XY uv, double enough) const;

 private:
  gp_XY inside(gp_XY uv) const;

  BRepAdaptor_Surface adaptor_;
};

}  // namespace lamina::cad
