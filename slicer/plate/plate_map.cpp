#include "slicer/plate/plate_map.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "plane/loop_area.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

constexpr double kLeastLetter = 0.8;  // [mm]
constexpr double kGreatestLetter = 4;

// A name in the middle of a piece, along its longer side. Letters are about
// half as wide as high.
std::string label(const std::string& name, const Box2& box, double depth) {
  const Vec2 size = box.size();
  const Vec2 middle = box.center();
  const auto letters =
      static_cast<double>(std::max<std::size_t>(name.size(), 1));
  const bool is_upright =
      size.y > 1.5 * size.x && 1.6 * size.x < kGreatestLetter * letters;
  const double height = std::clamp(
      1.6 * (is_upright ? size.y : size.x) / letters, kLeastLetter,
      std::clamp(std::min(size.x, size.y) / 2, kLeastLetter, kGreatestLetter));
  const Vec2 place(middle.x, depth - middle.y);
  return fmt::format(
      "<text x=\"{0:.2f}\" y=\"{1:.2f}\" font-size=\"{2:.2f}\"{3}>{4}</text>"
      "\n",
      place.x, place.y, height,
      is_upright ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"",
                               place.x, place.y)
                 : "",
      escape_html(name));
}

// The colours of neighbouring pieces differ, those of copies do not.
std::string color_of(std::size_t piece) {
  return fmt::format("hsl({} 55% 72%)", piece * 137 % 360);
}

}  // namespace

std::string plate_svg(std::span<const MappedPiece> pieces,
                      std::span<const Placement> placements, Vec2 size) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" "
      "height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\" "
      "text-anchor=\"middle\" dominant-baseline=\"central\" "
      "font-family=\"sans-serif\">\n"
      "<style>text{{paint-order:stroke;stroke:#fff;stroke-width:0.6px;stroke-"
      "linejoin:round}}"
      "</style>\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#f7f6f2\" "
      "stroke=\"#8a8577\" stroke-width=\"0.4\"/>\n",
      size.x, size.y);
  const auto out = std::back_inserter(svg);
  for (const Placement& placement : placements) {
    const MappedPiece& piece = pieces[placement.piece];
    const plane::Region placed =
        place(piece.footprint, placement.turn_deg, placement.shift);
    Box2 box;
    fmt::format_to(out,
                   "<path fill=\"{}\" fill-rule=\"evenodd\" stroke=\"#444\" "
                   "stroke-width=\"0.15\" d=\"",
                   color_of(placement.piece));
    for (const plane::Contour& contour : placed.contours) {
      char step = 'M';
      for (const Vec2& point : contour) {
        box.add(point);
        // The drawing's y runs down.
        fmt::format_to(out, "{}{:.2f} {:.2f}", step, point.x, size.y - point.y);
        step = 'L';
      }
      svg += 'Z';
    }
    fmt::format_to(out, "\"><title>{}</title></path>\n{}",
                   escape_html(piece.name), label(piece.name, box, size.y));
  }
  return svg + "</svg>\n";
}

std::string plate_page(std::span<const MappedPiece> pieces,
                       std::span<const MappedPlate> plates, Vec2 size) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<title>Plates</title><style>"
      "body{font:15px sans-serif;margin:2em auto;max-width:60em;padding:0 1em}"
      "h2{font-size:1em}svg{width:100%;height:auto}section{break-inside:avoid}"
      "li{display:inline-block;margin-right:1.5em}ul{padding:0}"
      "</style></head><body>\n";
  for (const MappedPlate& plate : plates) {
    page +=
        fmt::format("<section><h2>{}</h2>\n{}<ul>", escape_html(plate.title),
                    plate_svg(pieces, plate.placements, size));
    std::map<std::size_t, std::size_t> counts;
    for (const Placement& placement : plate.placements) {
      ++counts[placement.piece];
    }
    for (const auto& [piece, count] : counts) {
      page += fmt::format("<li>{} × {}</li>", count,
                          escape_html(pieces[piece].name));
    }
    page += "</ul></section>\n";
  }
  return page + "</body></html>\n";
}

}  // namespace lamina::slicer
