#pragma once
// CSG trees by hand: `b.node(Difference{}, {b.node(Cube{…}), …})`.

#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "csg/tree.h"

namespace lamina::csg {

class TreeBuilder {
 public:
  using Children = std::vector<const Node*>;

  template <typename Op>
  Node* node(Op op, const Children& children = {}) {
    Node* result = make<Node>();
    result->op = std::move(op);
    result->children = copy(std::span<const Node* const>(children));
    return result;
  }

  Node* transform(const Mat4& matrix, const Children& children) {
    return node(Transform{make<Mat4>(matrix)}, children);
  }
  Node* translate(Vec3 shift, const Children& children) {
    Mat4 m(1.0);
    m[3] = Vec4(shift, 1);
    return transform(m, children);
  }
  Node* scale(Vec3 factor, const Children& children) {
    Mat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i][i] = factor[i];
    return transform(m, children);
  }

  Node* cube(Vec3 size, bool center = false) {
    return node(Cube{size, center});
  }
  Node* sphere(double r, double fn) { return node(Sphere{r, {fn}}); }
  Node* cylinder(double h, double r1, double r2, double fn) {
    return node(Cylinder{h, r1, r2, false, {fn}});
  }

  Node* linear_extrude(const LinearExtrudeParams& params,
                       const Children& children) {
    return node(LinearExtrude{make<LinearExtrudeParams>(params)}, children);
  }
  Node* polygon(const std::vector<Vec2>& points) {
    return polygon(PolygonParams{copy(std::span<const Vec2>(points)), {}, 1});
  }
  Node* polygon(const PolygonParams& params) {
    return node(Polygon{make<PolygonParams>(params)});
  }
  Node* polyhedron(const std::vector<Vec3>& points,
                   const std::vector<std::vector<std::uint32_t>>& faces) {
    return node(Polyhedron{make<PolyhedronParams>(PolyhedronParams{
        copy(std::span<const Vec3>(points)), copy_lists(faces), 1})});
  }
  std::span<const std::span<const std::uint32_t>> copy_lists(
      const std::vector<std::vector<std::uint32_t>>& lists) {
    std::vector<std::span<const std::uint32_t>> copies;
    for (const auto& list : lists) {
      copies.push_back(copy(std::span<const std::uint32_t>(list)));
    }
    return copy(std::span<const std::span<const std::uint32_t>>(copies));
  }

  // The tree with these at the top level.
  Tree tree(const Children& children) {
    return {arena_, nullptr, node(Group{}, children)};
  }

  template <typename T>
  std::span<const T> copy(std::span<const T> from) {
    return arena_->copy(from);
  }

 private:
  template <typename T, typename... Arguments>
  T* make(Arguments&&... arguments) {
    return arena_->make(T{std::forward<Arguments>(arguments)...});
  }

  std::shared_ptr<Arena> arena_ = std::make_shared<Arena>();
};

}  // namespace lamina::csg
