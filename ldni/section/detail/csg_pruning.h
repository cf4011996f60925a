#pragma once
// CSG pruning, or null-object detection (Tilove 1984): which leaves can matter.
//
// Of a lattice that a sphere bounds, half of the struts lie outside the sphere;
// of a pattern of drills many meet nothing. Within the box of such a leaf other
// leaves decide the Boolean, and the leaf need not be cut in any layer.
//
// To see that, the ternary program is evaluated over the box. A leaf is
// judged by its box, and a body that is round or straight by bounds of its
// scale, in O(its rings): false where the box lies outside of it, true where
// the box lies inside, else unknown. A leaf below an operator that is decided
// while the leaf is unknown is left out.
//
// All answers keep a distance that ties of faces do not bridge. Leaves that are
// left out may decide about others: a leaf is true only over boxes smaller than
// its own, so larger leaves decide about smaller ones and never in a circle.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "csg/scene.h"
#include "plane/program/ternary_program.h"

namespace lamina::ldni::detail {

class CsgPruning {
 public:
  // The scene must outlive the object.
  explicit CsgPruning(const csg::Scene& scene);
  ~CsgPruning();
  CsgPruning(const CsgPruning&) = delete;
  CsgPruning& operator=(const CsgPruning&) = delete;

  // Whether the result may depend on the instance. Asks few other leaves, so
  // that it costs little however many there are.
  bool matters(std::uint32_t instance);

  // Counts the questions to leaves and operators, for all instances so far.
  std::uint64_t questions() const { return questions_; }

 private:
  // A child of an operator: another one, or an instance.
  struct Child {
    std::uint32_t number = 0;
    bool is_instance = false;

    bool operator==(const Child&) const = default;
  };
  // A leaf as it is asked about.
  struct Body;

  void list_children();
  bool is_decided_above(std::uint32_t instance, const Box3& box);
  void ask(std::uint32_t node, const Child& but, const Box3& box);
  plane::Ternary value_of(std::uint32_t instance, const Box3& box);

  const csg::Scene& scene_;
  // All is unknown but what is asked for this instance.
  plane::TernaryProgram program_;
  std::vector<std::uint32_t> known_;  // instances whose value is not unknown
  // Children of the operators that have few; operator i: [ends[i-1], ends[i]).
  std::vector<Child> children_;
  std::vector<std::uint32_t> ends_;
  std::unordered_map<std::uint32_t, Body> bodies_;
  std::uint64_t questions_ = 0;
  std::uint64_t last_question_ = 0;  // for this instance
};

}  // namespace lamina::ldni::detail
