#pragma once
// Supports of a part: where it must be held, and the way of each support down.
//
// A support is a **head**, a cone whose tip touches the part in a **contact**;
// a **pillar**, straight down or leaning by 45° until the way down is free; and
// a **foot** on the bed. Where no way leads to the bed, the pillar ends in a
// second tip on the part itself; and where that saves resin, it leans over to
// another pillar, like the branch of a **tree**. Tall pillars are tied to their
// neighbours by
// **braces**, and a **raft** can join all feet.
//
// A contact holds what is near. After PrusaSlicer 2.9, whose makers found it in
// test prints, that is 3.2 mm in the layer of a contact with a tip of 0.4 mm,
// and more above it: see hold_radius().
//
// A part that is mirrored or n-fold symmetric, seen from above, gets supports
// with the same symmetry.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

// All in mm.
struct SupportSizes {
  double tip = 0.3;        // diameter where it touches the part
  double head = 2.5;       // length of the cone, at most
  double pillar = 1;       // diameter
  double brace = 0.6;      // diameter
  double foot = 3;         // diameter on the bed
  double foot_height = 1;  // and that of a raft
  double lift = 5;         // of the part over the bed, at least
  double clearance = 0.5;  // between the part and all but the tips
  bool has_raft = false;   // in the place of feet
};

// How far from a contact it holds the part [mm].
//
// tip     diameter [mm]
// height  above the contact [mm]
double hold_radius(double tip, double height);

enum class SupportEnd : std::uint8_t { kFoot, kPart, kPillar };

struct Support {
  Vec3 contact = Vec3(0);  // the middle of the tip
  double tip = 0;          // its diameter [mm]
  double depth = 0;        // of the tip in the part, usually half of that [mm]
  // From inside the tip down: the end of the head, bends, the lowest point.
  std::vector<Vec3> path;
  SupportEnd end = SupportEnd::kFoot;
  std::string holds;  // the source line of what it holds; empty if not known

  // The upper end of the last part of the way.
  Vec3 pillar_top() const { return path[path.size() - 2]; }
};

// A rod between two pillars.
using Brace = std::array<Vec3, 2>;

// A text that is engraved in the top of a raft.
struct RaftLabel {
  std::string text;
  Vec2 origin = Vec2(0);    // where the text begins
  bool is_upright = false;  // it runs along y instead of x
  std::optional<Box2> tab;  // of the raft, for the text alone
};

struct SupportPlan {
  SupportSizes sizes;
  double bed = 0;  // height of the bed below the part [mm]
  std::vector<Support> supports;
  std::vector<Brace> braces;
  std::optional<RaftLabel> label;  // of a raft
  // Places that must be held and to which no way was found.
  std::vector<Vec3> unheld;
  // Places that must be held and where the design wants no supports.
  std::vector<Vec3> unwanted;

  // Supports that stand on the part.
  std::size_t count_on_part() const;

  // About: where rods meet, both count [mm³]; the disks of all tips [mm²].
  double volume() const;
  double contact_area() const;
};

// "7 supports, 1 of them on the part"
std::string size_text(const SupportPlan& plan);

// What the design wants below some of its leaves.
struct MarkedSolid {
  double tip = 0;  // the diameter of tips [mm]; 0: no supports
  // Of these leaves alone: the sections at the heights of the part's layers.
  std::vector<Layer> layers;
};

// Throws GeometryError where the part is wider than 500 mm.
//
// layers  of the whole part, in ascending order
// marked  where two of them are in one place, the first counts
SupportPlan plan_supports(std::span<const Layer> layers,
                          const SupportSizes& sizes,
                          std::span<const MarkedSolid> marked = {});

}  // namespace lamina::slicer
