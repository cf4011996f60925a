#pragma once
// All layers of a part stacked up and lit: the solid that the printer makes.
//
// No surface is reconstructed. OpenGL draws the layers as plates with upright
// sides, and returns for each pixel the place that it shows. Light takes its
// normal there from the surface that the plates approximate: between two
// sections the solid is where the depth in the one and the depth in the other,
// mixed by height, are more than 0 (the shape-based interpolation of Raya and
// Udupa 1990), and the gradient of that depth is normal to it. So slopes look
// as smooth as they are, whatever the layers' thickness; facets, edges and gaps
// stay.
//
// How much sky a place sees follows from the points around it in the picture.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slicer/contour/layer.h"
#include "slicer/picture/camera.h"
#include "slicer/picture/image.h"

namespace lamina::slicer {

// Colours of a picture of a solid: OpenSCAD's schemes by their names, and
// materials of jewelers.
struct ColorScheme {
  std::string_view name;
  Rgb background_top;  // of the picture
  Rgb background_bottom;
  Rgb solid;
  double shine;  // share of the light that is mirrored, 0 … 1
  Rgb supports;  // where layers know them
};

// Null where no scheme has that name.
const ColorScheme* find_color_scheme(std::string_view name);

std::vector<std::string> color_scheme_names();

struct StackOptions {
  unsigned width = 512;  // of the picture [pixels]
  unsigned height = 512;
  Camera camera;
  bool centers = true;    // the camera looks at the middle of the part
  bool shows_all = true;  // and from where all of it is seen
  const ColorScheme* colors = find_color_scheme("gold");
  // The color of what is seen at a place, on any thread; where it has none, or
  // this is empty, that of the layers or of the scheme.
  std::function<std::optional<Rgb>(Vec3 place)> paint = {};
};

// layers  ascending; at least one of them with a contour
//
// Throws FileError, with the package that is missing, where there is no OSMesa.
Image draw_stack(const std::vector<Layer>& layers, const StackOptions& options);

}  // namespace lamina::slicer
