#include "csg/cad/detail/tessellation.h"

#include <array>
#include <cstdint>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <NCollection_DataMap.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <fmt/format.h>

#include "csg/cad/detail/deviation.h"
#include "csg/limits.h"

namespace lamina::cad {
namespace {

// --- Vertices
// -----------------------------------------------------------------

template <typename Value>
using ByShape =
    NCollection_DataMap<TopoDS_Shape, Value, TopTools_ShapeMapHasher>;

class MeshBuilder {
 public:
  // Returns whether the face has triangles.
  bool add(const TopoDS_Face& face) {
    TopLoc_Location place;
    const auto triangulation = BRep_Tool::Triangulation(face, place);
    if (triangulation.IsNull() || triangulation->NbTriangles() == 0) {
      return false;
    }
    join_edges(face, triangulation, place);
    add_inner(*triangulation, place);
    add_triangles(*triangulation, (face.Orientation() == TopAbs_REVERSED) !=
                                      place.Transformation().IsNegative());
    return true;
  }

  csg::Mesh take() { return std::move(mesh_); }
  std::size_t triangle_count() const { return mesh_.triangles.size(); }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::uint32_t add_vertex(const gp_Pnt& p) {
    mesh_.vertices.emplace_back(p.X(), p.Y(), p.Z());
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // The mesh's vertex for an end of edges, which `p` is where it is new.
  std::uint32_t at_end(const TopoDS_Vertex& end, const gp_Pnt& p) {
    if (end.IsNull()) return add_vertex(p);
    if (const std::uint32_t* known = ends_.Seek(end)) return *known;
    const std::uint32_t vertex = add_vertex(p);
    ends_.Bind(end, vertex);
    return vertex;
  }

  // Gives the nodes of the face that lie on its edges their vertices.
  void join_edges(const TopoDS_Face& face,
                  const Handle(Poly_Triangulation) & triangulation,
                  const TopLoc_Location& place) {
    vertices_.assign(static_cast<std::size_t>(triangulation->NbNodes()), kNone);
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
      const auto polygon =
          BRep_Tool::PolygonOnTriangulation(edge, triangulation, place);
      if (polygon.IsNull()) continue;
      const auto point = [&](int i) {
        return triangulation->Node(polygon->Node(i)).Transformed(place);
      };
      const std::vector<std::uint32_t>& along =
          vertices_along(edge, polygon->NbNodes(), point);
      if (along.size() != static_cast<std::size_t>(polygon->NbNodes())) {
        continue;  // the file's own: it stays open there
      }
      for (int i = 1; i <= polygon->NbNodes(); ++i) {
        vertices_[static_cast<std::size_t>(polygon->Node(i) - 1)] =
            along[static_cast<std::size_t>(i - 1)];
      }
    }
  }

  template <typename Point>
  const std::vector<std::uint32_t>& vertices_along(const TopoDS_Edge& edge,
                                                   int count,
                                                   const Point& point) {
    if (const std::vector<std::uint32_t>* known = along_.Seek(edge)) {
      return *known;
    }
    std::vector<std::uint32_t> along;
    const TopoDS_Vertex first = TopExp::FirstVertex(edge);
    const TopoDS_Vertex last = TopExp::LastVertex(edge);
    if (BRep_Tool::Degenerated(edge)) {
      // A pole: the whole edge is a point.
      along.assign(static_cast<std::size_t>(count), at_end(first, point(1)));
    } else {
      along.push_back(at_end(first, point(1)));
      for (int i = 2; i < count; ++i) along.push_back(add_vertex(point(i)));
      along.push_back(at_end(last, point(count)));
    }
    return *along_.Bound(edge, std::move(along));
  }

  void add_inner(const Poly_Triangulation& triangulation,
                 const TopLoc_Location& place) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (vertices_[i] != kNone) continue;
      vertices_[i] = add_vertex(
          triangulation.Node(static_cast<int>(i + 1)).Transformed(place));
    }
  }

  // A triangle at a pole may have lost a side.
  void add_triangles(const Poly_Triangulation& triangulation, bool is_turned) {
    for (int i = 1; i <= triangulation.NbTriangles(); ++i) {
      std::array<int, 3> nodes{};
      triangulation.Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
      if (is_turned) std::swap(nodes[1], nodes[2]);
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = vertices_[static_cast<std::size_t>(nodes[k] - 1)];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] ||
          corners[2] == corners[0]) {
        continue;
      }
      mesh_.triangles.push_back(corners);
    }
  }

  csg::Mesh mesh_;
  ByShape<std::uint32_t> ends_;
  ByShape<std::vector<std::uint32_t>> along_;
  std::vector<std::uint32_t> vertices_;  // of the nodes of one face
};

// --- Deviation
// ----------------------------------------------------------------

void mesh(const TopoDS_Shape& shape, double deflection, double angle) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection;
  parameters.Angle = angle;
  BRepMesh_IncrementalMesh(shape, parameters);
}

// Meshes as finely as it takes; returns how far the result deviates.
double mesh_within(const TopoDS_Shape& shape, const Fineness& fineness) {
  // Each is half of the one before: the last is 1/64 of what was asked for.
  constexpr int kMostTrials = 7;
  double deflection = fineness.chordal_error;
  double deviation = 0;
  for (int i = 0; i < kMostTrials; ++i) {
    // The file may bring triangles along.
    BRepTools::Clean(shape);
    mesh(shape, deflection, fineness.angle);
    deviation = find_deviation(shape, fineness.chordal_error);
    if (deviation <= fineness.chordal_error) break;
    deflection /= 2;
  }
  return deviation;
}

}  // namespace

csg::Mesh tessellate(const Solid& solid, const Fineness& fineness,
                     std::vector<std::string>& warnings) {
  const double deviation = mesh_within(solid.shape, fineness);
  if (deviation > fineness.chordal_error) {
    warnings.push_back(fmt::format(
        "{}a face deviates by {:.3g} mm, more than the {:.3g} mm of "
        "--chordal-error",
        prefix_of(solid.name), deviation, fineness.chordal_error));
  }
  MeshBuilder builder;
  std::size_t without = 0;
  for (TopExp_Explorer at(solid.shape, TopAbs_FACE); at.More(); at.Next()) {
    if (!builder.add(TopoDS::Face(at.Current()))) ++without;
    if (static_cast<double>(builder.triangle_count()) > csg::kMostTriangles) {
      throw TooManyTriangles{static_cast<double>(builder.triangle_count())};
    }
  }
  if (without > 0) {
    warnings.push_back(fmt::format("{}{} faces could not be meshed",
                                   prefix_of(solid.name), without));
  }
  return builder.take();
}

}  // namespace lamina::cad
