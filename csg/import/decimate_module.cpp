// Decimation by OpenMesh, with a bound that holds.
//
// OpenMesh keeps the half-edges, decides which edges may collapse without a
// change of topology, and keeps the queue: the cheapest collapse comes first.
// What a collapse costs is decided here. It takes a vertex out of the fan of
// triangles around it and spans the hole by a fan from one of its neighbours:
//
//        o-----o             o-----o       the fan of v0 and the one of v1,
//       / \   / \           / \     \      seen along the normal of the former
//      o---v0---v1   ──▶   o--------v1
//       \ /   \ /           \ \     /
//        o-----o             o-----o
//
// Seen along the fan's mean normal both must cover the same polygon, each point
// once. This is the bound on normals: no triangle may turn over. Then both are
// heights over that polygon, linear on each cell in which the triangles of the
// two overlap, and so the greatest difference lies at a corner of a cell: at
// v0, or where a spoke of the old fan passes under one of the new one. Moving
// points along the normal maps one surface onto the other, and no point further
// than that. A collapse after the other maps the surface that came onto the one
// that leaves, and no point moves further than the sum of its ways: for each
// triangle the greatest sum of what it stands for is kept, and no collapse may
// raise it beyond the tolerance. As the map is one to one, the bound holds in
// both directions.
//
// OpenMesh's own module, ModHausdorffT, keeps the old vertices and asks that
// each stays near the new surface. Between them nothing is asked:
// docs/decisions/0035 has by how much it fails.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include "csg/import/detail/decimation_module.h"

namespace lamina::csg {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using OpenMesh::Vec3d;

// A fan of more triangles is left alone: its cost grows with their square.
constexpr std::size_t kMostSpokes = 64;

// How far a point may lie beyond a triangle's side and still count as in it, as
// a share of the triangle: far more than rounding, far less than shows.
constexpr double kSlack = 1e-9;

// --- One collapse -----------------------------------------------------------

// The ring of a fan, counter-clockwise, as seen along the fan's mean normal; v0
// is the origin and v1 the first point.
class Ring {
 public:
  void clear() {
    points_.clear();
    moves_.clear();
  }

  // move  how far points have been moved so far that are now in the triangle of
  //       v0, this point and the next one
  void add(const Vec3d& point, double move) {
    points_.push_back(point);
    moves_.push_back(move);
  }
  std::size_t size() const { return points_.size(); }

  // How far points have been moved, at most, that are in one of the triangles
  // of v1 and the points i and i + 1 of the ring (0 < i < size - 1), where
  // these replace the fan. Nothing where they cannot.
  std::optional<double> collapse() {
    if (!project() || !is_star()) return std::nullopt;
    const std::size_t n = size();
    steps_.assign(n, 0);
    new_moves_.assign(n, 0);
    // Triangles of both fans that share a side of the ring overlap there.
    for (std::size_t i = 1; i + 1 < n; ++i) new_moves_[i] = moves_[i];
    new_moves_[1] = std::max(new_moves_[1], moves_[0]);
    new_moves_[n - 2] = std::max(new_moves_[n - 2], moves_[n - 1]);
    if (!take_centre()) return std::nullopt;
    take_crossings();
    double greatest = 0;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      new_moves_[i] += steps_[i];
      greatest = std::max(greatest, new_moves_[i]);
    }
    return greatest;
  }

  // How far the triangle of v1 and the points i and i + 1 moves in collapse().
  double new_move(std::size_t i) const { return new_moves_[i]; }

 private:
  struct Seen {
    double x = 0;
    double y = 0;
    double height = 0;
  };

  static double cross(const Seen& a, const Seen& b) {
    return a.x * b.y - a.y * b.x;
  }

  bool project() {
    Vec3d normal(0, 0, 0);
    for (std::size_t i = 0; i < size(); ++i) {
      normal += points_[i] % points_[(i + 1) % size()];
    }
    const double length = normal.norm();
    if (!(length > 0)) return false;
    normal /= length;
    const bool is_along_x = std::abs(normal[0]) > 0.6;
    Vec3d u = is_along_x ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
    u = (u - normal * (u | normal)).normalize();
    const Vec3d v = normal % u;
    seen_.clear();
    for (const Vec3d& point : points_) {
      seen_.push_back({point | u, point | v, point | normal});
    }
    return true;
  }

  // Whether the ring's inside is seen whole from v0 and from v1.
  bool is_star() const {
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!(cross(seen_[i], seen_[(i + 1) % n]) > 0)) return false;
      if (i == 0 || i + 1 == n) continue;
      if (!(cross(from_v1(i), from_v1(i + 1)) > 0)) return false;
    }
    return true;
  }

  Seen from_v1(std::size_t i) const {
    return {seen_[i].x - seen_[0].x, seen_[i].y - seen_[0].y,
            seen_[i].height - seen_[0].height};
  }

  // v0 comes down on a new triangle, in which the whole old fan meets.
  bool take_centre() {
    const double most = *std::max_element(moves_.begin(), moves_.end());
    const Seen v0 = {-seen_[0].x, -seen_[0].y, -seen_[0].height};
    bool is_found = false;
    for (std::size_t i = 1; i + 1 < size(); ++i) {
      const Seen a = from_v1(i);
      const Seen b = from_v1(i + 1);
      const double s = cross(v0, b) / cross(a, b);
      const double t = cross(a, v0) / cross(a, b);
      if (s < -kSlack || t < -kSlack || s + t > 1 + kSlack) continue;
      is_found = true;
      const double height = s * a.height + t * b.height;
      raise(i, std::abs(height - v0.height), most);
    }
    return is_found;
  }

  // Where the spoke from v0 to point i passes the one from v1 to point j, the
  // triangles at both sides of either meet.
  void take_crossings() {
    for (std::size_t j = 2; j + 1 < size(); ++j) {
      const Seen b = from_v1(j);
      for (std::size_t i = 1; i < size(); ++i) {
        const Seen& a = seen_[i];
        const double area = cross(b, a);
        if (i == j || area == 0) continue;
        const double s = cross(b, seen_[0]) / area;
        const double t = cross(a, seen_[0]) / area;
        if (s < -kSlack || s > 1 + kSlack || t < -kSlack || t > 1 + kSlack) {
          continue;
        }
        const double step =
            std::abs(s * a.height - (seen_[0].height + t * b.height));
        const double move = std::max(moves_[i - 1], moves_[i]);
        raise(j - 1, step, move);
        raise(j, step, move);
      }
    }
  }

  void raise(std::size_t i, double step, double move) {
    steps_[i] = std::max(steps_[i], step);
    new_moves_[i] = std::max(new_moves_[i], move);
  }

  std::vector<Vec3d> points_;  // from v0
  std::vector<Seen> seen_;
  std::vector<double> moves_;
  // For each new triangle: what this collapse adds, and the moves after it.
  std::vector<double> steps_;
  std::vector<double> new_moves_;
};

// --- All of them ------------------------------------------------------------

template <typename Mesh>
class ModMovesT : public OpenMesh::Decimater::ModBaseT<Mesh> {
 public:
  using Base = OpenMesh::Decimater::ModBaseT<Mesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<ModMovesT<Mesh>>;
  using Collapse = typename Base::CollapseInfo;

  // It alone decides on the order of collapses.
  explicit ModMovesT(Mesh& mesh) : Base(mesh, false) {
    mesh.add_property(moves_);
  }
  ~ModMovesT() override { Base::mesh().remove_property(moves_); }
  ModMovesT(const ModMovesT&) = delete;
  ModMovesT& operator=(const ModMovesT&) = delete;

  const std::string& name() const override {
    static const std::string name = "Moves";
    return name;
  }

  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

  void initialize() override {
    for (const auto face : Base::mesh().faces()) move(face) = 0;
  }

  float collapse_priority(const Collapse& collapse) override {
    if (!take_ring(collapse)) return Base::ILLEGAL_COLLAPSE;
    // v1 must not become a fan too wide for what comes later.
    if (ring_.size() + valence_of(collapse.v1v0) > kMostSpokes + 4) {
      return Base::ILLEGAL_COLLAPSE;
    }
    const std::optional<double> moved = ring_.collapse();
    if (!moved || *moved > tolerance_) return Base::ILLEGAL_COLLAPSE;
    return static_cast<float>(*moved);
  }

  // The fan is still as it was when its priority was asked for: else that is
  // asked for again. v1 may have become wider.
  void preprocess_collapse(const Collapse& collapse) override {
    take_ring(collapse);
    ring_.collapse();
  }

  // The new fan stands from vl to vr around v1.
  void postprocess_collapse(const Collapse& collapse) override {
    Mesh& mesh = Base::mesh();
    HalfEdge at = mesh.find_halfedge(collapse.v1, collapse.vl);
    for (std::size_t i = 1; i + 1 < ring_.size(); ++i) {
      move(mesh.face_handle(at)) = ring_.new_move(i);
      at = next_around(at);
    }
  }

 private:
  using HalfEdge = typename Mesh::HalfedgeHandle;

  double& move(typename Mesh::FaceHandle face) {
    return Base::mesh().property(moves_, face);
  }

  // Counter-clockwise around the vertex that `at` leaves.
  HalfEdge next_around(HalfEdge at) {
    Mesh& mesh = Base::mesh();
    return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(at));
  }

  std::size_t valence_of(HalfEdge begin) {
    std::size_t valence = 0;
    HalfEdge at = begin;
    do {
      ++valence;
      at = Base::mesh().cw_rotated_halfedge_handle(at);
    } while (at != begin && valence <= kMostSpokes);
    return valence;
  }

  // False where the triangles around v0 are not a fan, or too many.
  bool take_ring(const Collapse& collapse) {
    Mesh& mesh = Base::mesh();
    ring_.clear();
    HalfEdge at = collapse.v0v1;
    do {
      const auto face = mesh.face_handle(at);
      if (!face.is_valid() || ring_.size() == kMostSpokes) return false;
      ring_.add(mesh.point(mesh.to_vertex_handle(at)) - collapse.p0,
                move(face));
      at = next_around(at);
    } while (at != collapse.v0v1);
    return ring_.size() >= 3;
  }

  double tolerance_ = 0;
  Ring ring_;
  OpenMesh::FPropHandleT<double> moves_;
};

// False where it is not a manifold.
bool build(const Mesh& mesh, HalfEdges& half_edges) {
  const std::size_t faces = mesh.triangles.size();
  half_edges.reserve(mesh.vertices.size(), 3 * faces / 2 + 1, faces);
  for (const Vec3& vertex : mesh.vertices) {
    half_edges.add_vertex({vertex.x, vertex.y, vertex.z});
  }
  const auto handle = [](std::uint32_t vertex) {
    return HalfEdges::VertexHandle(static_cast<int>(vertex));
  };
  for (const auto& t : mesh.triangles) {
    const auto face =
        half_edges.add_face(handle(t[0]), handle(t[1]), handle(t[2]));
    if (!face.is_valid()) return false;
  }
  return true;
}

void run(HalfEdges& mesh, const std::vector<bool>& is_fixed, double tolerance) {
  mesh.request_vertex_status();
  for (const auto vertex : mesh.vertices()) {
    const bool is_locked = is_fixed[static_cast<std::size_t>(vertex.idx())] ||
                           mesh.is_boundary(vertex);
    mesh.status(vertex).set_locked(is_locked);
  }
  OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(mesh);
  ModMovesT<HalfEdges>::Handle moves;
  decimater.add(moves);
  decimater.module(moves).set_tolerance(tolerance);
  decimater.initialize();
  decimater.decimate();
}

void take_triangles(const HalfEdges& half_edges, Mesh& mesh) {
  mesh.triangles.clear();
  for (const auto face : half_edges.faces()) {  // passes over deleted ones
    std::array<std::uint32_t, 3> triangle{};
    std::size_t i = 0;
    for (const auto vertex : half_edges.fv_range(face)) {
      triangle[i++] = static_cast<std::uint32_t>(vertex.idx());
    }
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) DecimationOutcome
lamina_decimate_manifold(int version, Mesh& mesh,
                         const std::vector<bool>& is_fixed, double tolerance) {
  if (version != kDecimationVersion) return DecimationOutcome::kOtherVersion;
  try {
    omerr().disable();
    HalfEdges half_edges;
    if (!build(mesh, half_edges)) return DecimationOutcome::kNoManifold;
    run(half_edges, is_fixed, tolerance);
    take_triangles(half_edges, mesh);
  } catch (const std::bad_alloc&) {
    return DecimationOutcome::kNoMemory;
  }
  return DecimationOutcome::kDone;
}

}  // namespace lamina::csg
