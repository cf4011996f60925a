#include "slicer/picture/color_scheme.h"

#include <array>
#include <iterator>

namespace lamina::slicer {
namespace {

constexpr Rgb rgb(unsigned hex) {
  return {static_cast<float>(hex >> 16 & 255) / 255,
          static_cast<float>(hex >> 8 & 255) / 255,
          static_cast<float>(hex & 255) / 255};
}

// A material before a soft light grey.
constexpr ColorScheme material(std::string_view name, unsigned solid,
                               double shine) {
  return {name, rgb(0xf4f4f2), rgb(0xdbdde0), rgb(solid), shine};
}

// Background and front faces of openscad's scheme of that name.
constexpr ColorScheme openscad(std::string_view name, unsigned background,
                               unsigned solid) {
  return {name, rgb(background), rgb(background), rgb(solid), 0.25};
}

constexpr std::array kSchemes = {
    material("gold", 0xf6c86f, 1),
    material("rose", 0xeab59b, 1),
    material("silver", 0xe6e6e8, 1),
    material("platinum", 0xcfd1d6, 0.9),
    material("wax", 0x3f8f6f, 0.3),
    material("resin", 0xd9a066, 0.3),
    openscad("Cornfield", 0xffffe5, 0xf9d72c),
    openscad("Metallic", 0xaaaaff, 0xddddff),
    openscad("Sunset", 0xaa4444, 0xffaaaa),
    openscad("Starnight", 0x000000, 0xffffe0),
    openscad("BeforeDawn", 0x333333, 0xcccccc),
    openscad("Nature", 0xfafafa, 0x16a085),
    openscad("DeepOcean", 0x333333, 0xeeeeee),
    openscad("Solarized", 0xfdf6e3, 0xb58800),
    openscad("Tomorrow", 0xf8f8f8, 0x4271ae),
    openscad("Tomorrow Night", 0x1d1f21, 0x81a2be),
    openscad("Monotone", 0xffffe5, 0xf9d72c),
};

}  // namespace

const ColorScheme* find_color_scheme(std::string_view name) {
  for (const ColorScheme& scheme : kSchemes) {
    if (scheme.name == name) return &scheme;
  }
  return nullptr;
}

std::vector<std::string> color_scheme_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kSchemes));
  for (const ColorScheme& scheme : kSchemes) names.emplace_back(scheme.name);
  return names;
}

}  // namespace lamina::slicer
