#include "csg/cad/detail/deviation.h"

#include <algorithm>
#include <optional>

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <ElSLib.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

namespace lamina::cad {
namespace {

// --- Edges -------------------------------------------------------------------

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

// --- Faces -------------------------------------------------------------------

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

// A step of Levenberg and Marquardt towards the parameters of the nearest
// point. The more it is damped, the shorter it is. Where a direction vanishes,
// as at a pole, only the other one counts.
gp_XY step_towards(const gp_Pnt& p, const BRepAdaptor_Surface& surface,
                   gp_XY uv, double damping) {
  gp_Pnt at;
  gp_Vec along_u;
  gp_Vec along_v;
  surface.D1(uv.X(), uv.Y(), at, along_u, along_v);
  const gp_Vec off(at, p);
  constexpr double kLeast = 1e-9;
  const double least =
      kLeast * (along_u.SquareMagnitude() + along_v.SquareMagnitude());
  const double uu = along_u.SquareMagnitude() * (1 + damping) + least;
  const double vv = along_v.SquareMagnitude() * (1 + damping) + least;
  const double across = along_u.Dot(along_v);
  const double determinant = uu * vv - across * across;
  if (!(determinant > 0)) return {};
  const double u = along_u.Dot(off);
  const double v = along_v.Dot(off);
  return {(vv * u - across * v) / determinant,
          (uu * v - across * u) / determinant};
}

}  // namespace

double deviation_of_edges(const TopoDS_Shape& shape) {
  double greatest = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    TopLoc_Location place;
    const auto triangulation = BRep_Tool::Triangulation(face, place);
    if (triangulation.IsNull()) continue;
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
      greatest = std::max(
          greatest,
          deviation_of_edge(TopoDS::Edge(at.Current()), triangulation, place));
    }
  }
  return greatest;
}

Surface::Surface(const TopoDS_Face& face) : adaptor_(face, Standard_False) {}

double Surface::distance(const gp_Pnt& p, gp_XY uv, double enough) const {
  double least = at(uv).Distance(p);
  if (least <= enough) return least;
  if (const auto nearest = nearest_by_formula(p, adaptor_)) {
    return at(*nearest).Distance(p);
  }
  // A step that leads no nearer is tried again, shorter.
  constexpr int kMostSteps = 10;
  constexpr double kLeastGain = 0.01;
  double damping = 0;
  for (int i = 0; i < kMostSteps && least > enough; ++i) {
    const gp_XY next = inside(uv + step_towards(p, adaptor_, uv, damping));
    const double distance = at(next).Distance(p);
    if (distance >= least) {
      damping = 10 * damping + 1;
      continue;
    }
    const bool is_nearest = distance > (1 - kLeastGain) * least;
    uv = next;
    least = distance;
    damping /= 10;
    if (is_nearest) break;
  }
  return least;
}

// Beyond the ends of a spline is no surface.
gp_XY Surface::inside(gp_XY uv) const {
  if (!adaptor_.IsUPeriodic()) {
    uv.SetX(std::clamp(uv.X(), adaptor_.FirstUParameter(),
                       adaptor_.LastUParameter()));
  }
  if (!adaptor_.IsVPeriodic()) {
    uv.SetY(std::clamp(uv.Y(), adaptor_.FirstVParameter(),
                       adaptor_.LastVParameter()));
  }
  return uv;
}

}  // namespace lamina::cad
