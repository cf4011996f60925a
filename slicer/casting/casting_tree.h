#pragma once
// A tree for casting: pieces that stand on a trunk, in one flask.
//
// The trunk is upright, its foot at z = 0 is where metal flows in, and pieces
// lean away from it by 45° or more upwards, as usual in the trade: so metal
// flows on from the trunk and wax out of the piece. A **stem** leads from the
// trunk's axis to the root of each piece's sprues. Heavy pieces are near the
// foot, where there is most metal behind them.
//
// Pieces are known by points of their surface. Between two points of two
// pieces there is the distance that is asked for and, on top, twice what a
// place of the surface may be from the nearest point. So the distance is kept.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

// All in mm.
struct TreeSizes {
  double flask_diameter = 80;  // inside
  double flask_height = 100;   // inside, from the foot of the tree
  double wall = 10;            // from pieces to the flask's wall, at least
  double top = 15;             // and to its end above them
  double foot = 15;            // from the foot to the lowest place of a piece
  double gap = 3;              // between pieces, and from them to the trunk
  double trunk = 8;            // diameter of the trunk
};

// A piece with its sprue, as it stands by itself.
struct TreePiece {
  std::vector<Vec3> points;  // of its surface, without the sprue
  std::vector<Vec3> sprue;   // and of the sprue's
  double cover = 0;  // greatest distance of a place of these from a point [mm]
  Vec3 root = Vec3(0);              // the sprue's
  double root_diameter = 0;         // [mm]
  Vec3 direction = Vec3(0, 0, -1);  // from the piece to the root; unit length
  double volume = 0;                // [mm³]
};

struct TreePlacement {
  std::size_t piece = 0;
  Affine tree_from_piece{1.0};
  Vec3 stem = Vec3(0);  // where the stem begins, on the axis
};

struct CastingTree {
  std::vector<TreePlacement> placements;
  double trunk_height = 0;  // [mm]
};

// Places as many of these as fit, the heaviest first and as low as it can; the
// same every time.
//
// wanted  for each piece to be placed its index into `pieces`; what has been
//         placed is taken out
CastingTree plant_tree(std::span<const TreePiece> pieces,
                       std::vector<std::size_t>& wanted,
                       const TreeSizes& sizes);

}  // namespace lamina::slicer
