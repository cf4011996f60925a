#include "slicer/formats/panel.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/diagnostic.h"
#include "slicer/formats/detail/known_panels.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::json;

constexpr unsigned kMostPixels = 65536;  // along a side

[[noreturn]] void fail(const std::string& name, std::string_view fault) {
  throw FileError(fmt::format("Can't use printer '{}': {}", name, fault));
}

Vec2 read_direction(const Json& json) {
  const std::string word = json.get<std::string>();
  if (word == "+x") return {1, 0};
  if (word == "-x") return {-1, 0};
  if (word == "+y") return {0, 1};
  if (word == "-y") return {0, -1};
  throw std::runtime_error(
      fmt::format("a direction is +x, -x, +y or -y, not '{}'", word));
}

PixelLayout read_layout(const Json& json, unsigned width) {
  const std::string word = json.get<std::string>();
  if (word == "grey") return PixelLayout::kGrey;
  if (word != "rgb") {
    throw std::runtime_error(
        fmt::format("nanodlp_pixels are grey or rgb, not '{}'", word));
  }
  if (width % 3 != 0) {
    throw std::runtime_error("rgb takes three pixels at a time");
  }
  return PixelLayout::kThreeInOne;
}

unsigned read_pixels(const Json& json) {
  const double pixels = json.get<double>();
  if (!(pixels >= 1 && pixels <= kMostPixels) || pixels != std::floor(pixels)) {
    throw std::runtime_error(
        fmt::format("pixels are from 1 to {}, not {}", kMostPixels, pixels));
  }
  return static_cast<unsigned>(pixels);
}

Panel read_panel(std::string_view text) {
  const Json json = Json::parse(text);
  Panel panel;
  panel.name = json.at("name").get<std::string>();
  panel.width = read_pixels(json.at("pixels").at(0));
  panel.height = read_pixels(json.at("pixels").at(1));
  panel.pixel = {json.at("pixel_mm").at(0).get<double>(),
                 json.at("pixel_mm").at(1).get<double>()};
  panel.right = read_direction(json.at("right"));
  panel.up = read_direction(json.at("up"));
  if (json.contains("nanodlp_pixels")) {
    panel.nanodlp_layout = read_layout(json.at("nanodlp_pixels"), panel.width);
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

Panel find_panel(const std::string& name_or_file, const FileAccess& access) {
  std::string names;
  for (const Panel& panel : known_panels()) {
    if (panel.name == name_or_file) return panel;
    names += " " + panel.name;
  }
  if (!name_or_file.ends_with(".json")) {
    fail(name_or_file,
         "lamina knows" + names + ", and files that end in .json");
  }
  access.require(name_or_file);
  const std::optional<std::string> text = access.read(name_or_file);
  if (!text || text->empty()) fail(name_or_file, "there is nothing to read");
  try {
    return read_panel(*text);
  } catch (const Json::exception& error) {
    // "[json.exception.…] words"
    const std::string_view words = error.what();
    fail(name_or_file, words.substr(words.find("] ") + 2));
  } catch (const std::runtime_error& error) {
    fail(name_or_file, error.what());
  }
}

}  // namespace lamina::slicer
