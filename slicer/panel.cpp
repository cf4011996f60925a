#include "slicer/panel.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "parser/diagnostic.h"
#include "slicer/known_panels.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::json;

constexpr unsigned kMostPixels = 65536;  // along a side

[[noreturn]] void fail(const std::string& name, std::string_view fault) {
  throw FileError({Severity::kError,
                   {},
                   fmt::format("Can't use printer '{}': {}", name, fault)});
}

Vec2 read_direction(const Json& word) {
  const std::string text = word.get<std::string>();
  const double sign = text.starts_with('-') ? -1 : 1;
  const std::string axis = text.substr(text.find_first_not_of("+-"));
  if (axis == "x") return {sign, 0};
  if (axis == "y") return {0, sign};
  throw std::runtime_error(
      fmt::format("a direction is +x, -x, +y or -y, not '{}'", text));
}

Panel read_panel(std::string_view text) {
  const Json json = Json::parse(text);
  Panel panel;
  panel.name = json.at("name").get<std::string>();
  panel.width = json.at("pixels").at(0).get<unsigned>();
  panel.height = json.at("pixels").at(1).get<unsigned>();
  panel.pixel = {json.at("pixel_mm").at(0).get<double>(),
                 json.at("pixel_mm").at(1).get<double>()};
  panel.right = read_direction(json.at("right"));
  panel.up = read_direction(json.at("up"));
  if (panel.width == 0 || panel.height == 0 || panel.width > kMostPixels ||
      panel.height > kMostPixels) {
    throw std::runtime_error(
        fmt::format("pixels must be 1 to {}", kMostPixels));
  }
  if (!(panel.pixel.x > 0) || !(panel.pixel.y > 0)) {
    throw std::runtime_error("pixel_mm must be positive");
  }
  if (panel.right.x * panel.up.x + panel.right.y * panel.up.y != 0) {
    throw std::runtime_error("right and up are one direction");
  }
  return panel;
}

}  // namespace

PixelMap Panel::map_around(Vec2 middle) const {
  PixelMap map;
  map.per_x = {right.x / pixel.x, -up.x / pixel.y};
  map.per_y = {right.y / pixel.x, -up.y / pixel.y};
  map.origin = Vec2(width, height) / 2.0 - map(middle);
  return map;
}

std::vector<Panel> known_panels() {
  std::vector<Panel> panels;
  for (const std::string_view profile : kKnownPanels) {
    panels.push_back(read_panel(profile));
  }
  return panels;
}

Panel find_panel(const std::string& name_or_file) {
  std::string names;
  for (const Panel& panel : known_panels()) {
    if (panel.name == name_or_file) return panel;
    names += " " + panel.name;
  }
  if (!name_or_file.ends_with(".json")) {
    fail(name_or_file,
         "lamina knows" + names + ", and files that end in .json");
  }
  std::ifstream file(name_or_file, std::ios::binary);
  if (!file) fail(name_or_file, "the file cannot be read");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  try {
    return read_panel(text);
  } catch (const std::exception& error) {
    fail(name_or_file, error.what());
  }
}

}  // namespace lamina::slicer
