#pragma once
// Sprues of a casting: rods through which metal flows into a piece.
//
// A sprue is a cone. It begins in the **root**, a ball where it will be joined
// to a tree, and ends in the **gate**, a ball that reaches into the piece. From
// there it narrows to the largest ball in the piece there, so that it comes out
// nowhere else. Where one place cannot feed all of the piece
// (slicer/thickness/feeding.h), there are several sprues with one root.
//
// Where a rod meets a plate the ball that fits is larger than in either: of a
// plate t thick and a rod k t wide it is (1 + k² / 4) t wide. So that the rod
// is no neck, it is kGateShare times as wide as the piece is thick.
//
// Rules of thumb (Stuller's and Formlabs's advice): a sprue is set where the
// piece is heaviest, is thicker than that, thinner towards the piece, straight,
// and no longer than necessary.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/thickness/feeding.h"

namespace lamina::slicer {

struct SprueSizes {
  // Diameter of the root [mm]; 0: kRootShare times that of the widest sprue.
  double root = 0;
  double length = 5;      // from the piece to the root's ball, at least [mm]
  bool has_disc = false;  // at the root, for pieces that stand on it

  bool operator==(const SprueSizes&) const = default;
};
inline constexpr double kGateShare = 1.4;
// How far the gate's ball is in the piece, at least [radii of it].
inline constexpr double kGateDepth = 0.3;
inline constexpr double kRootShare = 1.3;
// Diameter of the disc [diameters of the root], and its thickness [mm].
inline constexpr double kDiscShare = 3;
inline constexpr double kDiscThickness = 1.5;

// What is cut off and has less than this share of the piece's volume gets no
// sprue of its own, and there are no more than so many.
inline constexpr double kLeastFedShare = 0.05;
inline constexpr std::size_t kMostSprues = 4;

struct Sprue {
  Vec3 end = Vec3(0);          // the middle of the ball in the piece
  double thickness = 0;        // of the piece there, the ball's diameter [mm]
  Vec3 exit = Vec3(0);         // where the rod comes out of the piece
  Vec3 gate = Vec3(0);         // the middle of the ball outside
  double diameter = 0;         // of that [mm]
  double feeds = 0;            // volume of the pool that it is set for [mm³]
  std::uint32_t instance = 0;  // of the surface: csg::Scene::instances
  std::string at = {};         // its source line, if known
  bool is_seen = false;        // it comes out of a visible surface
};

struct SpruePlan {
  Vec3 root = Vec3(0);
  double root_diameter = 0;         // [mm]
  Vec3 direction = Vec3(0, 0, -1);  // from the piece to the root; unit length
  bool has_disc = false;
  std::vector<Sprue> sprues;  // that of the thickest place first
  std::vector<Pool> unfed;    // by none of them, the largest first
  double volume = 0;  // of all this outside the piece, counted in cells [mm³]
};

// What is not fed, but for places of less than kLeastUnfedShare of all.
std::vector<Pool> unfed_of(std::vector<Pool> pools);
inline constexpr double kLeastUnfedShare = 0.005;

// "not fed but through thinner places: 2 places of 12 mm³ in all, …"; empty for
// none.
std::string unfed_text(std::span<const Pool> pools);

// "2 sprues, root 4.1 mm wide, 66 mm³; not fed …"
std::string size_text(const SpruePlan& plan);

// Sprues by which the piece is fed. No value where no straight rod from any of
// its thick places gets out of it.
//
// samples     of the piece, of one pitch; balls and field are of them
// is_visible  whether a leaf (an index into csg::Scene::instances) is seen when
//             the piece is worn: sprues come out elsewhere, if they can
std::optional<SpruePlan> plan_sprues(
    const SolidSamples& samples, const BallFinder& balls,
    const ThicknessField& field, const SprueSizes& sizes,
    const std::function<bool(std::uint32_t instance)>& is_visible);

}  // namespace lamina::slicer
