#include "slicer/formats/detail/svg_writer.h"

#include <fmt/format.h>

#include "base/file/text_output.h"
#include "base/version.h"

namespace lamina::slicer {

SvgWriter::SvgWriter(const std::string& path, TemporaryFiles& temporary_files)
    : FloatWriter(path, temporary_files) {
  write_svg_head();
}

void SvgWriter::write_svg_head() {
  const FloatPoint low = contours_.low();
  const FloatPoint high = contours_.high();
  const std::string width = fixed_width(double{high.x} - low.x);
  const std::string height = fixed_width(double{high.y} - low.y);
  const std::string head = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg width=\"{}mm\" height=\"{}mm\" "
      "viewBox=\"{} {} {} {}\" "
      "xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\">\n"
      "  <!-- lamina {} -->\n",
      width, height, fixed_width(low.x), fixed_width(-high.y), width, height,
      version());
  write_head(head);
}

void SvgWriter::take(const Layer& layer) {
  print(output_, FMT_COMPILE("  <g id=\"layer{}\" slic3r:z=\"{}\">\n"), layers_,
        layer.section_z);
  ++layers_;
  contours_.take(layer);
  for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
    write_loop(contours_.loop(i));
  }
  output_.write("  </g>\n");
}

void SvgWriter::write_loop(std::span<const FloatPoint> closed_loop) {
  const bool is_hole = signed_area(closed_loop) < 0;
  print(output_, FMT_COMPILE("    <polygon slic3r:type=\"{}\" points=\""),
        is_hole ? "hole" : "contour");
  for (const FloatPoint& point : closed_loop.first(closed_loop.size() - 1)) {
    // 0 is added because -0 has a sign in print.
    print(output_, FMT_COMPILE("{},{} "), point.x + 0.0F, -point.y + 0.0F);
  }
  print(output_, FMT_COMPILE("\" style=\"fill: {}\" />\n"),
        is_hole ? "black" : "white");
}

void SvgWriter::finish(Diagnostics& diagnostics) {
  output_.write("</svg>\n");
  write_svg_head();
  contours_.warn_of_coarse_numbers("SVG", diagnostics);
}

}  // namespace lamina::slicer
