// Writes SVG in the layout of Slic3r: a group per layer, of polygons that are
// contours (white) or holes (black), in millimetres (docs/formats.md).
//
// Coordinates are float32 (float_writer.h), as browsers hold them, with the
// shortest digits that read back as them. x and y are the design's; SVG's y
// runs downwards, so y is negated and the drawing shows a layer from above.
// The size of the drawing is known last: its numbers have a fixed width and
// are patched at the end.

#include <cstdint>

#include <fmt/format.h>

#include "base/version.h"
#include "slicer/formats/detail/float_writer.h"
#include "slicer/formats/detail/text_output.h"

namespace lamina::slicer {
namespace {

class SvgWriter : public FloatWriter {
 public:
  SvgWriter(const std::string& path, TemporaryFiles& temporary_files)
      : FloatWriter("SVG", path, temporary_files) {
    write_svg_head();
  }

  void take(const Layer& layer) override {
    print(output_, FMT_COMPILE("  <g id=\"layer{}\" slic3r:z=\"{}\">\n"),
          layers_++, layer.section_z);
    contours_.take(layer);
    for (std::size_t i = 0; i < contours_.loop_count(); ++i) write_loop(i);
    output_.write("  </g>\n");
  }

 private:
  void write_svg_head() {
    const FloatPoint low = contours_.low();
    const FloatPoint high = contours_.high();
    const std::string width = fixed_width(double{high.x} - low.x);
    const std::string height = fixed_width(double{high.y} - low.y);
    write_head(
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<svg width=\"{}mm\" height=\"{}mm\" "
                    "viewBox=\"{} {} {} {}\" "
                    "xmlns=\"http://www.w3.org/2000/svg\" "
                    "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\">\n"
                    "  <!-- lamina {} -->\n",
                    width, height, fixed_width(low.x), fixed_width(-high.y),
                    width, height, version()));
  }

  void write_loop(std::size_t i) {
    const bool is_hole = contours_.is_hole(i);
    print(output_, FMT_COMPILE("    <polygon slic3r:type=\"{}\" points=\""),
          is_hole ? "hole" : "contour");
    for (const FloatPoint& point : contours_.open_loop(i)) {
      // 0 is added because -0 has a sign in print.
      print(output_, FMT_COMPILE("{},{} "), point.x + 0.0F, -point.y + 0.0F);
    }
    print(output_, FMT_COMPILE("\" style=\"fill: {}\" />\n"),
          is_hole ? "black" : "white");
  }

  void end_file() override {
    output_.write("</svg>\n");
    write_svg_head();
  }

  std::uint32_t layers_ = 0;
};

}  // namespace

std::unique_ptr<LayerWriter> make_svg_writer(const WriterOptions& /*options*/,
                                             const std::string& path,
                                             TemporaryFiles& temporary_files) {
  return std::make_unique<SvgWriter>(path, temporary_files);
}

}  // namespace lamina::slicer
