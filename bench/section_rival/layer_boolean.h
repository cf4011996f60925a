#pragma once
// The Boolean program of a scene on the polygons of one layer, by Clipper.
//
// Polygons of leaves wind once around their inside, so a union is no more than
// their collection until something needs its outline: one pass of the clipper
// with the non-zero rule does a difference of unions whole.
//
// The clipper's time grows faster than the number of edges that it is given at
// once. So what is far apart is clipped apart: loops whose boxes hang together
// are a group, and a group that the other operand's outline does not reach is
// kept or dropped as a whole.

#include <cstdint>
#include <span>
#include <vector>

#include <polyclipping/clipper.hpp>

#include "bench/section_rival/sectioner.h"
#include "csg/scene.h"

namespace lamina::rival {

class LayerBoolean {
 public:
  explicit LayerBoolean(const csg::Scene& scene);

  // Loops of an instance in the layer in hand.
  void add(std::uint32_t instance, const std::vector<Loop>& loops);

  // Replaces `result` by the outline of the scene, valid until the next layer;
  // forgets the loops.
  void run(std::vector<const Path*>& result);

 private:
  // Loops whose winding numbers are above 0 inside, 0 outside.
  struct Operand {
    std::vector<Loop> loops;
    IntBox box;
    bool is_outline = true;  // loops do not cross and wind once

    bool is_empty() const { return loops.empty(); }
    void add(const Loop& loop);
    void add(Operand& value);
    void clear();
  };
  // Where a value goes: an operand of a node.
  struct Slot {
    std::uint32_t node;
    std::uint32_t operand;
  };
  struct Node {
    plane::BooleanOp op;
    Slot parent;
    std::vector<Operand> operands;  // union 1, difference 2, intersection all
  };
  // Neighbours in the loops of an operand.
  struct Group {
    std::uint32_t begin;
    std::uint32_t end;
    IntBox box;
  };

  Slot take_slot(std::uint32_t parent, bool is_minuend);
  Operand& evaluate(Node& node);
  Operand& intersect(Node& node);
  void clip(ClipperLib::ClipType type, Operand& left, Operand& right);
  void sort_into_groups(std::vector<Loop>& loops);
  void join_neighbours(std::vector<Loop>& loops);
  std::uint32_t group_of(std::uint32_t loop);
  void clip_together(ClipperLib::ClipType type, std::span<const Loop> left,
                     std::span<const Loop> right);

  const csg::Scene& scene_;
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;  // of the instances
  Operand result_;           // of the clip in hand
  PathPool pool_;            // of results
  std::vector<Group> groups_;
  std::vector<Loop> together_;  // groups for one pass of the clipper
  std::vector<Loop> sorted_;
  std::vector<std::uint32_t> leader_;  // of a loop's group, by and by
  std::vector<std::uint32_t> rank_;    // of a leader's group
  std::vector<std::uint32_t> reach_;   // loops that the sweep still meets
  ClipperLib::Clipper clipper_;
  ClipperLib::Paths solution_;
};

}  // namespace lamina::rival
