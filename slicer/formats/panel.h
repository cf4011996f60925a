#pragma once
// The image panel of a resin printer: which pixel shows which place.

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
  // Which direction of the design runs to the right and which upwards in the
  // image: ±x and ±y. Panels seen from below show a mirrored part.
  Vec2 right = Vec2(1, 0);
  Vec2 up = Vec2(0, 1);

  // How NanoDLP hands pixels to its display.
  PixelLayout nanodlp_layout = PixelLayout::kGrey;

  // Whether it shows a part turned over.
  bool is_mirrored() const { return right.x * up.y - right.y * up.x < 0; }

  // Where places go if `middle` [mm] is in the middle of the panel.
  PixelMap map_around(Vec2 middle) const;
};

// The panels that lamina knows, in alphabetical order of their names.
std::vector<Panel> known_panels();

// A panel that lamina knows by that name, else a printer profile: a JSON file
// (docs/formats.md).
//
// throws  FileError where there is none, or the file is no profile, AccessError
//         where the file may not be read
Panel find_panel(const std::string& name_or_file,
                 const FileAccess& access = kAllFiles);

}  // namespace lamina::slicer
