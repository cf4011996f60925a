#pragma once
// surface(): a mountain over a grid of heights, from text or from an image.

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
  double bottom = 0;            // 1 mm below the least height, 0 at most [mm]
  std::string fault;            // why it ends before the file does; "" if not
};

// Numbers by rows; "#" begins a comment line. Rows that are too short end in 0.
// A word that is no number ends the field.
//
// throws  LimitExceeded, before the short rows are made longer
HeightField parse_dat(std::string_view bytes);

// Heights are the luminances of the pixels, black 0 and white 100 mm; the
// image's lowest row comes first. Inverted they are 100/255 mm less what they
// were, as in OpenSCAD 2021.01.
//
// throws  FormatError for what is no PNG image; LimitExceeded
HeightField parse_png(std::string_view bytes, bool invert);

// Four triangles to each cell of the grid, around the mean of its corners, and
// walls down to the bottom. Closed; nothing for less than two rows or columns.
Mesh make_surface(const HeightField& field, bool center);

// The surface of a file; nothing where it cannot be read, which is reported
// with OpenSCAD's words at `range`.
Mesh read_surface_file(const SurfaceParams& params, const FileAccess& access,
                       SourceRange range, Diagnostics& diagnostics);

}  // namespace lamina::csg
