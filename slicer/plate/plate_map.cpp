#include "slicer/plate/plate_map.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "plane/loop_area.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// Letters are about half as wide as high.
double letter_height(std::string_view name, Vec2 room) {
  const auto letters =
      static_cast<double>(std::max<std::size_t>(name.size(), 1));
  return std::clamp(1.6 * room.x / letters, 0.8, std::max(0.8, room.y / 3));
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
      "height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\">\n"
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
    const Vec2 middle = (box.low + box.high) / 2.0;
    fmt::format_to(out,
                   "\"><title>{0}</title></path>\n<text x=\"{1:.2f}\" "
                   "y=\"{2:.2f}\" font-size=\"{3:.2f}\" "
                   "text-anchor=\"middle\" dominant-baseline=\"middle\" "
                   "font-family=\"sans-serif\">{0}</text>\n",
                   escaped(piece.name), middle.x, size.y - middle.y,
                   letter_height(piece.name, box.size()));
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
      "svg{width:100%;height:auto}section{break-inside:avoid}"
      "li{display:inline-block;margin-right:1.5em}ul{padding:0}"
      "</style></head><body>\n";
  for (const MappedPlate& plate : plates) {
    page += fmt::format("<section><h2>{}</h2>\n{}<ul>", escaped(plate.title),
                        plate_svg(pieces, plate.placements, size));
    std::map<std::size_t, std::size_t> counts;
    for (const Placement& placement : plate.placements) {
      ++counts[placement.piece];
    }
    for (const auto& [piece, count] : counts) {
      page +=
          fmt::format("<li>{} × {}</li>", count, escaped(pieces[piece].name));
    }
    page += "</ul></section>\n";
  }
  return page + "</body></html>\n";
}

}  // namespace lamina::slicer
