#pragma once
// Finds overhangs: parts of a layer that are too far from what holds them.
//
// A **ledge** is a gap between two chains on the ray that is solid in the layer
// above and void in the one below (layer_overlay.h). Places of a square grid
// are asked how far they are from the solid below, and so are the vertices of
// the layer above. The grid depends on the ledges alone, so that what else the
// layer holds changes nothing.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/edge_tree.h"
#include "plane/order/chain_cursor.h"

namespace lamina::slicer {

// A part of a solid region that is too far from what holds it.
struct Overhang {
  std::uint32_t region = 0;  // above
  Box2 box;
  double area = 0;       // as sampled [mm²]
  double distance = 0;   // the greatest to what holds it [mm]
  Vec2 place = Vec2(0);  // where that is
};

// A ledge from one x to another, between two chains.
struct Ledge {
  std::uint32_t region = 0;
  double begin = 0;
  double end = 0;
  plane::ChainCursor lower;  // at `begin`
  plane::ChainCursor upper;
  bool is_lower_held = false;  // the chain bounds the solid below
  bool is_upper_held = false;

  bool has_free_side() const { return is_lower_held != is_upper_held; }
};

class OverhangSearch {
 public:
  // Appends the overhangs of the ledges in their order, one of each at most.
  //
  // reach  how far a layer may stand out over the one below [mm]
  void find(const plane::Contours& below, const plane::Contours& above,
            std::span<const Ledge> ledges, double reach,
            std::vector<Overhang>& found);

 private:
  struct Part;

  double least_pitch(std::span<const Ledge> ledges) const;
  void search(const Ledge& ledge);
  void search_part(const Part& part);
  void search_columns(const Part& part);
  double search_column(const Part& part, double x, double columns);
  void ask_middle(const Part& part);
  void ask_vertex(const Part& part, Vec2 vertex);
  double ask(const Part& part, Vec2 place);
  double distance_to_chains(const Part& part, Vec2 place) const;
  void look_around(const plane::ChainCursor& from, const Vec2* first,
                   Vec2 place, double& least) const;
  double low_at(const Part& part, double x) const;
  double high_at(const Part& part, double x) const;

  const plane::Contours* below_ = nullptr;
  double reach_ = 0;
  Box2 box_;  // of the layer above
  double pitch_ = 0;
  // Of the layer below; filled once a place asks for more than the chains
  // beside its ledge.
  plane::EdgeTree tree_;
  bool is_tree_filled_ = false;
  std::size_t guess_ = 0;
  // Of the ledge in hand.
  Overhang overhang_;
  double column_ = 0;            // the next one
  Vec2 asked_vertex_ = Vec2(0);  // of a free side
  bool does_vertex_hang_over_ = false;
};

}  // namespace lamina::slicer
