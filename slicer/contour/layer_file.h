#pragma once
// What a file of layers holds beside their contours, whatever its format:
// readers (slicer/formats) fill it in, checks (slicer/check) judge it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

// A loop as its file holds it: with the closing vertex, unless it is open.
struct WrittenLoop {
  std::uint32_t gaps = 0;    // as the file counts them
  std::vector<Vec2> points;  // [mm]
};

// A row of a table of thicknesses: layers from `min_z` upwards [file's unit].
struct SamplingRow {
  float min_z = 0;
  float thickness = 0;
  float line_width_compensation = 0;
};

// The loops as a sound file holds them: each ends with its first point again.
inline std::vector<WrittenLoop> closed_loops(const plane::Contours& contours) {
  std::vector<WrittenLoop> closed(contours.loop_count());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    closed[i].points.assign(loop.begin(), loop.end());
    if (!loop.empty()) closed[i].points.push_back(loop.front());
  }
  return closed;
}

// Loops of a file that have the same fault.
struct FaultyLoops {
  std::uint64_t count = 0;
  std::size_t layer = 0;  // of the first one, from 1
  Vec2 place = Vec2(0);   // its first point; 0, 0 where it has none [mm]

  void add(std::size_t number_of_layer, std::span<const Vec2> points) {
    if (count++ > 0) return;
    layer = number_of_layer;
    if (!points.empty()) place = points.front();
  }
};

struct LayerFileFacts {
  std::string format;  // "SLC 2.0", "CLI, binary"; empty: layers of a design
  std::string writer;  // program that made it; empty: not known
  // Bound on the contours' deviation from the design's sections, if noted [mm].
  std::optional<double> deviation;
  // Coordinates are 32-bit numbers.
  bool is_float32 = true;
  // false: only heights of sections; sides of layers are then halfway between.
  bool has_sides = true;
  // Loops of which the format asks for their first point at their end, and that
  // end with another: readers close them.
  FaultyLoops open_loops;
  // Loops of fewer than three points, which readers leave out.
  FaultyLoops short_loops;
  // What of the file was not taken, each kind with its number: "open
  // polyline", "circle element".
  std::map<std::string, std::uint64_t> left_out;
  // SLC alone has these: a line of words, the table of thicknesses, the low and
  // high of x, y, z [file's unit], and the top of the part [mm].
  std::string header;
  std::vector<SamplingRow> sampling;
  std::optional<std::array<Vec2, 3>> extents;
  std::optional<double> top;
};

// "2 open polylines, 1 circle element", the first ones; empty where nothing was
// left out.
std::string left_out_text(const LayerFileFacts& facts);

}  // namespace lamina::slicer
