#pragma once
// surface(): a solid below a grid of heights, from text or from an image.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// Heights over a grid of 1 mm, row by row from y = 0 up.
struct HeightField {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> heights;  // rows × columns [mm]
  // 1 mm below the least height [mm]; at most 0, but for images in 2026.
  double bottom = 0;
  std::string fault;  // why it ends before the file does; "" if it does not
};

// Reads numbers by rows; "#" begins a comment line. Short rows are filled up
// with 0. A word that is not a number ends the field, and in 2026 empties it.
//
// throws  LimitExceeded, before short rows are filled up
HeightField parse_dat(std::string_view bytes, Language rules = Language::k2021);

// Heights are the luminances of the pixels, black 0 and white 100 mm; the
// image's lowest row comes first. `invert` subtracts them from 100/255 mm, as
// OpenSCAD does.
//
// throws  FormatError for a malformed image; LimitExceeded
HeightField parse_png(std::string_view bytes, bool invert,
                      Language rules = Language::k2021);

// Makes a closed mesh: four triangles for each cell of the grid, around the
// mean of its corners, and walls down to the bottom. It is empty for less than
// two rows or columns.
Mesh make_surface(const HeightField& field, bool center);

// Reads the surface of a file; empty where it cannot be read, which is reported
// in OpenSCAD's words at `range`.
Mesh read_surface_file(const SurfaceParams& params, const FileAccess& access,
                       SourceRange range, Diagnostics& diagnostics);

}  // namespace lamina::csg
