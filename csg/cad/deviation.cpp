#include "csg/cad/detail/deviation.h"

#include <algorithm>
#include <array>
#include <optional>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <ElSLib.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

namespace lamina::cad {
namespace {

// --- Edges
// --------------------------------------------------------------------

double distance_to_segment(gp_XYZ p, gp_XYZ a, gp_XYZ b) {
  const gp_XYZ along = b - a;
  const double length2 = along.SquareModulus();
  const double t =
      length2 > 0 ? std::clamp((p - a).Dot(along) / length2, 0.0, 1.0) : 0;
  return (p - (a + along * t)).Modulus();
}

double deviation_of_edge(const TopoDS_Edge& edge,
                         const Handle(Poly_Triangulation) & triangulation,
                         const TopLoc_Location& place) {
  const auto polygon =
      BRep_Tool::PolygonOnTriangulation(edge, triangulation, place);
  if (polygon.IsNull() || !polygon->HasParameters() ||
      BRep_Tool::Degenerated(edge)) {
    return 0;
  }
  const BRepAdaptor_Curve curve(edge);
  const auto node = [&](int i) {
    return triangulation->Node(polygon->Node(i)).Transformed(place).XYZ();
  };
  double greatest = 0;
  for (int i = 1; i < polygon->NbNodes(); ++i) {
    const double from = polygon->Parameter(i);
    const double to = polygon->Parameter(i + 1);
    for (const double share : {0.25, 0.5, 0.75}) {
      const gp_XYZ p = curve.Value(from + share * (to - from)).XYZ();
      greatest =
          std::max(greatest, distance_to_segment(p, node(i), node(i + 1)));
    }
  }
  return greatest;
}

// --- Faces
// --------------------------------------------------------------------

// The parameters of the nearest point, where there is a formula for them.
std::optional<gp_XY> nearest_by_formula(const gp_Pnt& p,
                                        const BRepAdaptor_Surface& surface) {
  double u = 0;
  double v = 0;
  switch (surface.GetType()) {
    case GeomAbs_Cylinder:
      ElSLib::Parameters(surface.Cylinder(), p, u, v);
      break;
    case GeomAbs_Cone:
      ElSLib::Parameters(surface.Cone(), p, u, v);
      break;
    case GeomAbs_Sphere:
      ElSLib::Parameters(surface.Sphere(), p, u, v);
      break;
    case GeomAbs_Torus:
      ElSLib::Parameters(surface.Torus(), p, u, v);
      break;
    default:
      return std::nullopt;
  }
  return gp_XY(u, v);
}

// A step of Gauss and Newton towards the parameters of the nearest point.
gp_XY step_towards(const gp_Pnt& p, const BRepAdaptor_Surface& surface,
                   gp_XY uv) {
  gp_Pnt at;
  gp_Vec along_u;
  gp_Vec along_v;
  surface.D1(uv.X(), uv.Y(), at, along_u, along_v);
  const gp_Vec off(at, p);
  // Where a direction vanishes, as at a pole, only the other one counts.
  constexpr double kDamping = 1e-9;
  const double damping =
      kDamping * (along_u.SquareMagnitude() + along_v.SquareMagnitude());
  const double uu = along_u.SquareMagnitude() + damping;
  const double vv = along_v.SquareMagnitude() + damping;
  const double across = along_u.Dot(along_v);
  const double determinant = uu * vv - across * across;
  if (!(determinant > 0)) return {};
  const double u = along_u.Dot(off);
  const double v = along_v.Dot(off);
  return {(vv * u - across * v) / determinant,
          (uu * v - across * u) / determinant};
}

// A face's surface, asked for distances.
class Distances {
 public:
  explicit Distances(const TopoDS_Face& face)
      : face_(face), surface_(face, Standard_False) {}

  bool is_plane() const { return surface_.GetType() == GeomAbs_Plane; }

  // The distance of p, or any that is at most `enough`: that of the point at
  // (u, v), which need not be the nearest, and where it is too far that of
  // nearer ones.
  double distance(const gp_Pnt& p, gp_XY uv, double enough) {
    constexpr int kMostSteps = 4;
    double least = distance_at(p, uv);
    if (least <= enough) return least;
    if (const auto nearest = nearest_by_formula(p, surface_)) {
      return distance_at(p, *nearest);
    }
    for (int i = 0; i < kMostSteps; ++i) {
      uv += step_towards(p, surface_, uv);
      least = std::min(least, distance_at(p, uv));
      if (least <= enough) return least;
    }
    return std::min(least, searched_distance(p));
  }

 private:
  double distance_at(const gp_Pnt& p, gp_XY uv) const {
    return surface_.Value(uv.X(), uv.Y()).Distance(p);
  }

  // By OpenCASCADE's search, which is slow and finds it at poles, too.
  double searched_distance(const gp_Pnt& p) {
    if (search_.IsNull()) {
      search_ = new ShapeAnalysis_Surface(BRep_Tool::Surface(face_));
    }
    search_->ValueOfUV(p, Precision::Confusion());
    return search_->Gap();
  }

  const TopoDS_Face& face_;
  BRepAdaptor_Surface surface_;
  Handle(ShapeAnalysis_Surface) search_;
};

double deviation_within(const TopoDS_Face& face,
                        const Poly_Triangulation& triangulation,
                        const TopLoc_Location& place, double limit) {
  Distances distances(face);
  if (distances.is_plane() || !triangulation.HasUVNodes()) return 0;
  // The middle, those of the sides, and between each of these and the middle.
  constexpr double kShares[7][3] = {{1. / 3, 1. / 3, 1. / 3},
                                    {0.5, 0.5, 0},
                                    {0, 0.5, 0.5},
                                    {0.5, 0, 0.5},
                                    {0.25, 0.25, 0.5},
                                    {0.25, 0.5, 0.25},
                                    {0.5, 0.25, 0.25}};
  double greatest = 0;
  for (int i = 1; i <= triangulation.NbTriangles() && greatest <= limit; ++i) {
    int corners[3];
    triangulation.Triangle(i).Get(corners[0], corners[1], corners[2]);
    gp_XYZ points[3];
    gp_XY uv[3];
    for (int k = 0; k < 3; ++k) {
      points[k] = triangulation.Node(corners[k]).Transformed(place).XYZ();
      uv[k] = triangulation.UVNode(corners[k]).XY();
    }
    for (const auto& share : kShares) {
      gp_XYZ p;
      gp_XY at;
      for (int k = 0; k < 3; ++k) {
        p += points[k] * share[k];
        at += uv[k] * share[k];
      }
      greatest = std::max(greatest, distances.distance(p, at, limit));
    }
  }
  return greatest;
}

double deviation_of_face(const TopoDS_Face& face, double limit) {
  TopLoc_Location place;
  const auto triangulation = BRep_Tool::Triangulation(face, place);
  if (triangulation.IsNull()) return 0;
  double greatest = 0;
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    greatest = std::max(greatest, deviation_of_edge(TopoDS::Edge(at.Current()),
                                                    triangulation, place));
  }
  return greatest > limit
             ? greatest
             : std::max(greatest,
                        deviation_within(face, *triangulation, place, limit));
}

}  // namespace

double find_deviation(const TopoDS_Shape& shape, double limit) {
  double greatest = 0;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More() && greatest <= limit;
       at.Next()) {
    greatest = std::max(greatest,
                        deviation_of_face(TopoDS::Face(at.Current()), limit));
  }
  return greatest;
}

}  // namespace lamina::cad
