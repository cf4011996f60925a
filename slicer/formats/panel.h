#pragma once
// The image panel of a resin printer, and where on it a part is shown.

#include <string>
#include <vector>

#include "base/file/file_access.h"
#include "base/vec.h"
#include "slicer/formats/coverage.h"

namespace lamina::slicer {

// How pixels stand in a PNG file.
enum class PixelLayout {
  kGrey,  // 8 bits each
  // Three neighbours are red, green and blue of one pixel: 8 bits each. The
  // width must be a multiple of three.
  kThreeInOne,
};

struct Panel {
  std::string name;
  unsigned width = 0;  // [pixels]
  unsigned height = 0;
  Vec2 pixel = Vec2(0);  // its size to the right and upwards [mm]
  // The directions of the design that run to the right and upwards in the
  // image, ±x and ±y. Panels seen from below show a mirrored part.
  Vec2 right = Vec2(1, 0);
  Vec2 up = Vec2(0, 1);

  // How NanoDLP hands pixels to its display.
  PixelLayout nanodlp_layout = PixelLayout::kGrey;

  // Whether the panel shows a mirrored part.
  bool is_mirrored() const { return right.x * up.y - right.y * up.x < 0; }

  // Maps the design to pixels so that `middle` [mm] is in the panel's middle.
  PixelMap map_around(Vec2 middle) const;
};

// The panels that lamina knows, in alphabetical order of their names.
std::vector<Panel> known_panels();

// Returns the panel that lamina knows by that name, or else that of a printer
// profile: a JSON file (docs/formats.md).
//
// throws  FileError where there is no such panel, or the file is no profile;
//         AccessError where the file may not be read
Panel find_panel(const std::string& name_or_file,
                 const FileAccess& access = kAllFiles);

}  // namespace lamina::slicer
