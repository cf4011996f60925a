#pragma once
// By which rules the layer graph judges a print.

#include <cstddef>
#include <cstdint>
#include <set>

namespace lamina::slicer {

// What may go wrong; see layer_graph.h.
enum class FindingKind : std::uint8_t {
  kIsland,
  kLoosePart,
  kOverhang,
  kSuctionCup,
  kResinTrap
};
inline constexpr std::size_t kFindingKinds = 5;
inline const std::set<FindingKind> kAllFindings = {
    FindingKind::kIsland, FindingKind::kLoosePart, FindingKind::kOverhang,
    FindingKind::kSuctionCup, FindingKind::kResinTrap};

struct PrintRules {
  // How far a layer may stand out over the one below before that is reported
  // [mm]; 0: as far as a surface of 45° does.
  double self_supporting = 0;
  // What is smaller is too small to matter, whatever it is: a pixel of the
  // printer where that is known [mm²], and one in a layer [mm³].
  double least_area = 0.001;
  double least_volume = 0.0005;
  // A print with one of these, if it matters, is not to be made.
  std::set<FindingKind> fail_on = {};
};

}  // namespace lamina::slicer
