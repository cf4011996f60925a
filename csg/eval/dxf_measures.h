#pragma once
// What dxf_dim() and dxf_cross() read of a DXF file: dimensions, and lines that
// touch no other line.
//
// Only straight entities (LINE, LWPOLYLINE) count as lines here; curves and
// inserted blocks are for the reader of shapes.

#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "csg/vec.h"

namespace lamina::csg {

struct DxfDimension {
  int type = 0;
  std::array<Vec2, 7> points = {};  // groups 10…16 and 20…26
  double angle_deg = 0;
  std::string name;
};

struct DxfMeasures {
  std::vector<DxfDimension> dimensions;
  std::vector<std::array<Vec2, 2>> lone_lines;  // in the order of the file
  // Entities of the layer that OpenSCAD does not know, with their number, in
  // the order in which its hash table gives them back.
  std::unordered_map<std::string, int> unknown_entities;
};

// Reads one layer, or all if `layer` is empty. Points are moved by -origin and
// scaled. A file that cannot be read measures nothing.
DxfMeasures read_dxf_measures(const std::string& path, const std::string& layer,
                              Vec2 origin, double scale);

}  // namespace lamina::csg
