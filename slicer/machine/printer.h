#pragma once
// A resin printer: its build volume, the panel of pixels that hardens a layer,
// and where on it a part is shown.

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/vec.h"

namespace lamina::slicer {

// How pixels stand in a PNG file.
enum class PixelLayout {
  kGrey,  // 8 bits each
  // Three neighbours are red, green and blue of one pixel: 8 bits each. The
  // width must be a multiple of three.
  kThreeInOne,
};

// How the platform leaves the film behind a layer and comes back.
struct PlatformMoves {
  double lift = 5;                // [mm]
  double lift_speed = 60;         // [mm/min]
  double retract_speed = 150;     // [mm/min]
  double wait_before_lift = 0;    // after the exposure [s]
  double wait_after_retract = 0;  // before the exposure [s]
};

struct Printer {
  std::string name;
  std::string title;   // as its manufacturer writes it
  std::string source;  // of these figures
  // Of the panel [pixels]; 0: it has none, and takes layers of contours.
  unsigned width = 0;
  unsigned height = 0;
  Vec2 pixel = Vec2(0);  // its size to the right and upwards [mm]
  // The directions of the design that run to the right and upwards in the
  // image, ±x and ±y. Panels seen from below show a mirrored part.
  Vec2 right = Vec2(1, 0);
  Vec2 up = Vec2(0, 1);
  // What one without a panel builds, along the axes of the design [mm].
  Vec2 plate = Vec2(0);
  double build_height = 0;  // [mm]; 0: not known
  // What it takes to lift the part from the film and to come back, for each
  // layer [s]; 0: not known.
  double move_seconds = 0;
  // Behind the first layers, and behind the others.
  PlatformMoves first_moves;
  PlatformMoves moves;

  // The formats that it reads, by their extensions without the dot, best first;
  // "encrypted.ctb" and others that lamina does not write are among them.
  // Empty: not known.
  std::vector<std::string> reads;
  unsigned ctb_version = 3;  // of the .ctb that it reads: 2, 3 or 4

  // How NanoDLP hands pixels to its display.
  PixelLayout nanodlp_layout = PixelLayout::kGrey;

  bool has_panel() const { return width > 0; }

  // Whether the panel shows a mirrored part.
  bool is_mirrored() const { return right.x * up.y - right.y * up.x < 0; }

  // What it builds, along the axes of the design [mm]; z is infinite where the
  // height is not known.
  Vec3 build_volume() const;
};

// The printers that lamina knows, in alphabetical order of their names.
std::vector<Printer> known_printers();

// Returns the printer that lamina knows by that name, its title, or a part of
// them that no other has ("mars 3"), or else that of a profile: a JSON file
// (docs/formats.md).
//
// throws  FileError where there is no such printer or there are several, or the
//         file is not a profile;
//         AccessError where the file may not be read
Printer find_printer(const std::string& name_or_file,
                     const FileAccess& access = kAllFiles);

// Whether it builds a part of that size along the axes of the design [mm].
bool fits(const Printer& printer, Vec3 size);

// A part is larger than what the printer builds. Its message names known
// printers that are large enough.
struct TooLarge : GeometryError {
  // size  of the part along the axes of the design [mm]
  TooLarge(const Printer& printer, Vec3 its_size);

  Vec3 size;
};

// "The design is 200 x 10 x 10 mm, larger than what elegoo-mars-3 builds: …"
std::string too_large_text(const Printer& printer, Vec3 size);

}  // namespace lamina::slicer
