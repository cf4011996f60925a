#include "cli/help.h"

namespace lamina::cli {

const std::string_view kHelp =
    R"(lamina compiles OpenSCAD designs straight to the layers of a 3D printer.

Usage:
  lamina DESIGN [-o FILE] [OPTION]...     slice a .scad or .csg design
  lamina inspect FILE.slc [OPTION]...     check a layer file and list it
  lamina view FILE -o PICTURE.png         draw a layer file or a design

Output:
  -o FILE             the output, by its extension; '-' is standard output;
                      without it, ring.slc beside ring.scad
                        .slc             layers for wax and resin printers
                        .cli             Common Layer Interface
                        .svg             a group of polygons per layer, or the
                                         outline of a 2D design
                        .png             a folder of images
                        .sl1             images for Prusa's resin printers
                        .layers.json     layers with every digit
                        .csg .echo .ast  what the design makes, says, and is
  --export-format F   one of these formats, whatever the output's name
  --printer P         of images: whose panel they are for: a name or a file of
                      profile (see docs/formats.md) [plain; of .sl1 prusa-sl1]
  --mirror x|y|xy     of images: turned over
  --cli ENCODING      of .cli: binary or ascii [binary]

Design:
  -D NAME=VALUE       set a variable of the design; may be repeated
  -p FILE -P SET      set its parameters from a file of the customizer
  --check-parameters true|false
                      warn of arguments that a module does not take [true]
  --check-parameter-ranges true|false
                      warn of numbers out of range [false]
  --hardwarnings      stop at the first warning
  --seed N            seed of rands() where the design gives none [0]
  --render            $preview is false, whatever the output
  -d FILE             write what the output depends on, as a rule for make

Slicing (lengths in millimetres):
  --layer MM          thickness of a layer [0.05]
  --heights Z1,Z2,... sections at exactly these heights instead, ascending
  --axis AXIS         direction of building: z, x, y, -x, -y or -z [z]
  --chordal-error MM  distance of facets from curves where $fn does not say
                      [$fa and $fs decide]
  --tolerance MM, --simplify MM
                      write the fewest vertices within this distance of the
                      contour; 0 writes all [0.001]
  --scale FACTOR      size of the print over that of the design, such as 1.02
                      where casting shrinks [1]
  --compensate MM     move contours into the solid by half the width of the
                      beam; negative: out of it [0]
  --ray auto|MM       distance of the rays; speed only, except for
                      --contour paper [auto]
  --threads N         threads at work [as many as the machine has]

For comparison, the method of Zeng et al. 2011:
  --contour MODE      faithful: exact contours; paper: linked rays [faithful]
  --boxes MODE        of paper: local or global depth images [local]
  --sampler KIND      of paper: scanline, gl (drawn by OpenGL), or gl-peeling
                      (by depth peeling, as published) [scanline]

Checks:
  --min-feature MM    tell of walls and gaps thinner than this, and of what
                      made them
  --report FILE       write times, counts, memory, the bound on what contours
                      deviate by, and thin features, as JSON

Messages:
  -q, --quiet         say nothing but errors
  -h, --help          print this help
  -v, --version       print the version

Examples:
  lamina ring.scad                        ring.slc, layers of 0.05 mm
  lamina ring.scad -o wax.slc --layer 0.025 -D size=54
  lamina inspect ring.slc                 is it sound? how much wax?
  lamina view ring.slc -o ring.png --style stack

Exit status: 0 done, 1 the design or a file is at fault, 2 usage,
130 interrupted.
)";

const std::string_view kInspectHelp =
    R"(Usage: lamina inspect FILE.slc [OPTION]...

Shows the header, the layers and the totals of a .slc file and checks its
loops: closed, without repeats, crossings and empty loops, turned as their
nesting asks for, layers rising. Ends with 1 if there is a defect.

  --all       list every layer of a long file
  --min-feature MM
              tell of walls and gaps thinner than this
  -h, --help  print this help
)";

const std::string_view kViewHelp =
    R"(Usage: lamina view FILE -o PICTURE.png [OPTION]...

Draws the layers of a .slc file, or of a .scad or .csg design with any option
of Design and Slicing (see 'lamina --help').

  -o FILE         the picture
  --style STYLE   sheet: single layers side by side; stack: all layers on top
                  of each other, as a solid [sheet]
  --layers N      layers on a sheet, filled up to whole rows [20]
  --width PIXELS  width of the picture [1600]
  -q, --quiet     say nothing but errors
  -h, --help      print this help
)";

}  // namespace lamina::cli
