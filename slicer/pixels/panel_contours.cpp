#include "slicer/pixels/panel_contours.h"

#include <algorithm>

#include <fmt/format.h>

#include "slicer/contour/simplify.h"
#include "slicer/pixels/detail/pixel_contours.h"

namespace lamina::slicer {
namespace {

// Contours are simplified within this distance [pixels]: they are not more
// accurate themselves.
constexpr double kTolerance = 0.05;

}  // namespace

plane::Contours contours_on_panel(std::span<const std::uint8_t> pixels,
                                  const Printer& printer) {
  plane::Contours contours =
      trace_pixels(pixels, printer.width, printer.height);
  const Vec2 middle(printer.width / 2.0, printer.height / 2.0);
  for (Vec2& point : contours.points) {
    const Vec2 mm = (point - middle) * printer.pixel;
    point = printer.right * mm.x - printer.up * mm.y;
  }
  if (printer.is_mirrored()) {
    std::uint32_t begin = 0;
    for (const std::uint32_t end : contours.ends) {
      std::reverse(contours.points.begin() + begin,
                   contours.points.begin() + end);
      begin = end;
    }
  }
  Simplifier(kTolerance * std::min(printer.pixel.x, printer.pixel.y))
      .simplify(contours);
  return contours;
}

LayerFileFacts panel_file_facts(const std::string& format, std::size_t images,
                                const Printer& printer,
                                const std::string& writer) {
  LayerFileFacts facts;
  facts.format = fmt::format(
      "{}, {} images of {} x {} pixels of {:g} x {:g} mm", format, images,
      printer.width, printer.height, printer.pixel.x, printer.pixel.y);
  facts.writer = writer;
  facts.is_float32 = false;
  return facts;
}

}  // namespace lamina::slicer
