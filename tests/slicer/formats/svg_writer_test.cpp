// SVG in the layout of Slic3r, as docs/formats.md describes it.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/version.h"
#include "tests/slicer/formats/writing.h"
#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

using support::add_loop;

std::string write_svg(const std::vector<Layer>& layers) {
  return written(layers, {.format = OutputFormat::kSvg});
}

std::string head(const std::string& size_and_view) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg {} "
      "xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\">\n"
      "  <!-- lamina {} -->\n",
      size_and_view, version());
}

TEST(SvgWriter, WritesAGroupPerLayerSeenFromAbove) {
  Layer pierced;
  pierced.section_z = 0.25;
  add_loop(pierced.contours, {{-1, 0}, {4, 0}, {4, 8}, {-1, 8}});
  add_loop(pierced.contours, {{1, 1}, {1, 3}, {3, 3}, {3, 1}});
  Layer empty;
  empty.section_z = 0.75;
  EXPECT_EQ(
      write_svg({pierced, empty}),
      head("width=\"5.00000000000mm\" height=\"8.00000000000mm\" "
           "viewBox=\"-1.0000000000 -8.0000000000 5.00000000000 "
           "8.00000000000\"") +
          "  <g id=\"layer0\" slic3r:z=\"0.25\">\n"
          "    <polygon slic3r:type=\"contour\" points=\"-1,0 4,0 4,-8 -1,-8 "
          "\" style=\"fill: white\" />\n"
          "    <polygon slic3r:type=\"hole\" points=\"1,-1 1,-3 3,-3 3,-1 \" "
          "style=\"fill: black\" />\n"
          "  </g>\n"
          "  <g id=\"layer1\" slic3r:z=\"0.75\">\n"
          "  </g>\n"
          "</svg>\n");
}

TEST(SvgWriter, EndsWellWithoutLayers) {
  EXPECT_EQ(write_svg({}),
            head("width=\"0.00000000000mm\" height=\"0.00000000000mm\" "
                 "viewBox=\"0.00000000000 0.00000000000 0.00000000000 "
                 "0.00000000000\"") +
                "</svg>\n");
}

}  // namespace
}  // namespace lamina::slicer
