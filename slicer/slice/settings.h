#pragma once
// The settings of a slicing job, from the command line or a library's user.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ldni/image/paper_slicer.h"
#include "slicer/check/print/print_rules.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/deviation.h"

namespace lamina::slicer {

enum class ContourMode { kFaithful, kPaper };

// Layers by number, counted from 1 as `lamina inspect` does; the last belongs
// to them.
struct LayerNumbers {
  std::uint32_t first = 1;
  std::uint32_t last = 0xffffffff;

  bool contains(std::uint32_t layer) const {
    return first <= layer && layer <= last;
  }
  bool operator==(const LayerNumbers&) const = default;
};

struct Settings {
  double layer_thickness = 0.05;  // [mm]
  // Not 0: adaptive layers, multiples of layer_thickness, whose steps on the
  // surface have no greater cusp than this [mm] (adaptive.h).
  double cusp = 0;
  double greatest_thickness = 0;  // of these [mm]; 0: 4 · layer_thickness
  // Runs of layers of equal thickness that the output can hold, at most.
  std::size_t most_thickness_runs = std::numeric_limits<std::size_t>::max();
  std::vector<double> heights;  // not empty: sections at exactly these
  LayerNumbers written;         // which of the layers
  double ray_pitch = 0;         // [mm]; 0 = auto
  double tolerance = 0.001;     // [mm]; 0 writes all vertices
  double compensation = 0;      // [mm] inwards; negative: outwards
  Foot foot;                    // of the first layers that have a contour
  // Walls and gaps thinner than this are searched for, in faithful contours
  // only [mm]; 0: there is no search.
  double min_feature = 0;
  PrintRules print;
  bool keeps_colors = false;  // of color(): Layer::colored
  bool finds_makers = false;  // of what the layer graph finds: its leaves
  ContourMode contour = ContourMode::kFaithful;
  ldni::PaperOptions paper;  // for ContourMode::kPaper
  unsigned threads = 0;      // 0: as many as the machine has
};

// Whether the layers are the whole print, so that the layer graph can say what
// hangs together.
bool makes_whole_print(const Settings& settings);

// Whether some layer has other contours than the scene's section.
bool moves_contours(const Settings& settings);

// Bounds that the contours keep before they are written; none for the paper's.
std::optional<Deviation> promised_deviation(const Settings& settings);

}  // namespace lamina::slicer
