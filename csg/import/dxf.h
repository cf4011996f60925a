#pragma once
// DXF drawings, as OpenSCAD 2021.01 understands them.
//
// LINE, LWPOLYLINE (bulges count as straight), CIRCLE, ARC, ELLIPSE and INSERT
// become lines on a grid of 2^-10 mm, whose ends meet where they are no further
// apart than one step of it; lines that meet are joined to paths. Other
// entities are only counted.

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

struct DxfOptions {
  std::string layer;  // empty: all
  Vec2 origin = Vec2(0);
  double scale = 1;
  // Number of sides of a full circle of that radius.
  std::function<int(double radius)> fragments;
  std::string path;  // as messages show it
  // That may be drawn, beside 20 for each byte of the file.
  std::size_t most_lines = 1'000'000;
};

struct DxfPath {
  std::vector<Vec2> points;  // the first one is not repeated at the end
  bool is_closed = false;
};

struct DxfDimension {
  int type = 0;
  std::array<Vec2, 7> points = {};  // groups 10…16 and 20…26
  double angle_deg = 0;
  std::string name;
};

struct DxfDrawing {
  std::vector<DxfPath> paths;  // open ones first
  std::vector<DxfDimension> dimensions;
  // In OpenSCAD's words: of values that are not numbers, and the like.
  std::vector<std::string> warnings;
  // How many entities of each kind that OpenSCAD does not know are in the
  // layer, in the order of its hash table.
  std::unordered_map<std::string, int> unknown_entities;
  int straightened_arcs = 0;  // bulges of polylines in the layer
};

// throws  FormatError where blocks inserted into blocks, or arcs of many turns,
//         make too many lines
DxfDrawing parse_dxf(std::string_view bytes, const DxfOptions& options);

// OpenSCAD's warnings about unknown entities.
//
// shown_path  quoted, as OpenSCAD shows it
std::vector<std::string> unknown_entity_warnings(const DxfDrawing& drawing,
                                                 const std::string& layer,
                                                 const std::string& shown_path);

}  // namespace lamina::csg
