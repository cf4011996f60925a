#include "csg/cad/detail/tessellation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <BRepBuilderAPI_NurbsConvert.hxx>
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
#include "csg/cad/detail/face_mesh.h"
#include "csg/limits.h"

namespace lamina::cad {
namespace {

using Index = std::uint32_t;

template <typename Value>
using ByShape =
    NCollection_DataMap<TopoDS_Shape, Value, TopTools_ShapeMapHasher>;

// Puts the triangles of faces together.
class MeshBuilder {
 public:
  explicit MeshBuilder(double chordal_error) : chordal_error_(chordal_error) {}

  // Returns whether the face has triangles.
  bool add(const TopoDS_Face& face) {
    TopLoc_Location place;
    const auto triangulation = BRep_Tool::Triangulation(face, place);
    if (triangulation.IsNull() || triangulation->NbTriangles() == 0) {
      return false;
    }
    FaceMesh of_face = face_mesh(face, *triangulation, place);
    deviation_ = std::max(deviation_, refine(face, chordal_error_, of_face));
    vertices_.assign(of_face.points.size(), kNone);
    join_edges(face, triangulation, place, of_face);
    add_inner(of_face);
    add_triangles(of_face);
    return true;
  }

  csg::Mesh take() { return std::move(mesh_); }
  std::size_t triangle_count() const { return mesh_.triangles.size(); }
  // The greatest of all faces, or any that is at most the chordal error.
  double deviation() const { return deviation_; }

 private:
  static constexpr Index kNone = ~Index{0};

  Index add_vertex(const gp_Pnt& p) {
    mesh_.vertices.emplace_back(p.X(), p.Y(), p.Z());
    return static_cast<Index>(mesh_.vertices.size() - 1);
  }

  // The mesh's vertex for an end of edges, which `p` is where it is new.
  Index at_end(const TopoDS_Vertex& end, const gp_Pnt& p) {
    if (end.IsNull()) return add_vertex(p);
    if (const Index* known = ends_.Seek(end)) return *known;
    const Index vertex = add_vertex(p);
    ends_.Bind(end, vertex);
    return vertex;
  }

  // Gives the nodes of the face that lie on its edges their vertices.
  void join_edges(const TopoDS_Face& face,
                  const Handle(Poly_Triangulation) & triangulation,
                  const TopLoc_Location& place, const FaceMesh& of_face) {
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
      const auto polygon =
          BRep_Tool::PolygonOnTriangulation(edge, triangulation, place);
      if (polygon.IsNull()) continue;
      std::vector<std::size_t> nodes;
      for (int i = 1; i <= polygon->NbNodes(); ++i) {
        nodes.push_back(static_cast<std::size_t>(polygon->Node(i) - 1));
      }
      const std::vector<Index>& along = vertices_along(edge, nodes, of_face);
      // Else the edge is cut otherwise here than in another face.
      if (along.size() != nodes.size()) continue;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        vertices_[nodes[i]] = along[i];
      }
    }
  }

  const std::vector<Index>& vertices_along(
      const TopoDS_Edge& edge, const std::vector<std::size_t>& nodes,
      const FaceMesh& of_face) {
    if (const std::vector<Index>* known = along_.Seek(edge)) return *known;
    const auto point = [&](std::size_t i) { return of_face.points[nodes[i]]; };
    const std::size_t last = nodes.size() - 1;
    std::vector<Index> along(nodes.size(), kNone);
    along.front() = at_end(TopExp::FirstVertex(edge), point(0));
    if (BRep_Tool::Degenerated(edge)) {
      // A pole: the whole edge is a point.
      std::fill(along.begin(), along.end(), along.front());
    } else {
      for (std::size_t i = 1; i < last; ++i) along[i] = add_vertex(point(i));
      along.back() = at_end(TopExp::LastVertex(edge), point(last));
    }
    return *along_.Bound(edge, along);
  }

  void add_inner(const FaceMesh& of_face) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (vertices_[i] == kNone) vertices_[i] = add_vertex(of_face.points[i]);
    }
  }

  // A triangle at a pole may have lost a side.
  void add_triangles(const FaceMesh& of_face) {
    for (const auto& nodes : of_face.triangles) {
      const std::array<Index, 3> corners = {
          vertices_[nodes[0]], vertices_[nodes[1]], vertices_[nodes[2]]};
      if (corners[0] != corners[1] && corners[1] != corners[2] &&
          corners[2] != corners[0]) {
        mesh_.triangles.push_back(corners);
      }
    }
  }

  const double chordal_error_;
  double deviation_ = 0;
  csg::Mesh mesh_;
  ByShape<Index> ends_;
  ByShape<std::vector<Index>> along_;
  std::vector<Index> vertices_;  // of the nodes of one face
};

// Returns how far chords of edges are from these.
double mesh(const TopoDS_Shape& shape, double deflection, double angle) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection;
  parameters.Angle = angle;
  // The file may bring triangles along.
  BRepTools::Clean(shape);
  const BRepMesh_IncrementalMesh mesher(shape, parameters);
  return deviation_of_edges(shape);
}

// Meshes until the chords of edges are as near as they have to be, or as near
// as OpenCASCADE makes them; returns how far they are.
double mesh_edges_within(const TopoDS_Shape& shape, const Fineness& fineness) {
  double deflection = fineness.chordal_error;
  double deviation = mesh(shape, deflection, fineness.angle);
  while (deviation > fineness.chordal_error &&
         deflection / 2 >= kLeastChordalError) {
    const double finer = mesh(shape, deflection / 2, fineness.angle);
    // In some files the ends of chords are off their edge, which no finer ones
    // cure.
    constexpr double kLeastGain = 0.9;
    if (finer > kLeastGain * deviation) {
      return mesh(shape, deflection, fineness.angle);
    }
    deflection /= 2;
    deviation = finer;
  }
  return deviation;
}

struct Tessellation {
  csg::Mesh mesh;
  double deviation = 0;        // or any that is at most the chordal error
  std::size_t bare_faces = 0;  // without triangles
};

Tessellation tessellate_shape(const TopoDS_Shape& shape,
                              const Fineness& fineness) {
  Tessellation result;
  const double of_edges = mesh_edges_within(shape, fineness);
  MeshBuilder builder(fineness.chordal_error);
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    if (!builder.add(TopoDS::Face(at.Current()))) ++result.bare_faces;
    const auto triangles = static_cast<double>(builder.triangle_count());
    if (triangles > csg::kMostTriangles) throw TooManyTriangles{triangles};
  }
  result.deviation = std::max(of_edges, builder.deviation());
  result.mesh = builder.take();
  return result;
}

}  // namespace

csg::Mesh tessellate(const Solid& solid, const Fineness& fineness,
                     std::vector<std::string>& warnings) {
  Tessellation result = tessellate_shape(solid.shape, fineness);
  if (result.bare_faces > 0) {
    // BRepMesh makes no triangles of some cones, but of the same faces as
    // splines.
    result = tessellate_shape(BRepBuilderAPI_NurbsConvert(solid.shape).Shape(),
                              fineness);
  }
  if (result.bare_faces > 0) {
    warnings.push_back(fmt::format("{}{} faces could not be meshed",
                                   prefix_of(solid.name), result.bare_faces));
  }
  if (result.deviation > fineness.chordal_error) {
    warnings.push_back(fmt::format(
        "{}a face deviates by {:.3g} mm, more than the chordal error of "
        "{:.3g} mm",
        prefix_of(solid.name), result.deviation, fineness.chordal_error));
  }
  return std::move(result.mesh);
}

}  // namespace lamina::cad
