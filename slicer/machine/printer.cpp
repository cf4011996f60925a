#include "slicer/machine/printer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "slicer/machine/detail/profile.h"

namespace lamina::slicer {
namespace {

using nlohmann::json;

constexpr unsigned kMostPixels = 65536;  // along a side
constexpr double kGreatestHeight = 10'000;
constexpr double kGreatestPixel = 10;
constexpr double kLongestMove = 1000;
constexpr double kGreatestSpeed = 100'000;  // [mm/min]

// Printers that a message names, at most.
constexpr std::size_t kMostNamed = 3;

Vec2 read_direction(const json& word_of) {
  const std::string word = word_of.get<std::string>();
  if (word == "+x") return {1, 0};
  if (word == "-x") return {-1, 0};
  if (word == "+y") return {0, 1};
  if (word == "-y") return {0, -1};
  throw std::runtime_error(
      fmt::format("a direction is +x, -x, +y or -y, not '{}'", word));
}

PixelLayout read_layout(const json& word_of, unsigned width) {
  const std::string word = word_of.get<std::string>();
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

// A number for the first layers and one for the others.
void read_pair(const json& object, const char* member, double greatest,
               double& first, double& other) {
  if (!object.contains(member)) return;
  const json& pair = object.at(member);
  first = pair.at(0).get<double>();
  other = pair.at(1).get<double>();
  for (const double value : {first, other}) {
    if (!(value >= 0 && value <= greatest)) {
      throw std::runtime_error(
          fmt::format("{} must be from 0 to {}", member, greatest));
    }
  }
}

void read_moves(const json& object, Printer& printer) {
  PlatformMoves& first = printer.first_moves;
  PlatformMoves& other = printer.moves;
  read_pair(object, "lift_mm", kGreatestHeight, first.lift, other.lift);
  read_pair(object, "lift_mm_per_min", kGreatestSpeed, first.lift_speed,
            other.lift_speed);
  read_pair(object, "wait_before_lift_s", kLongestMove, first.wait_before_lift,
            other.wait_before_lift);
  read_pair(object, "wait_after_retract_s", kLongestMove,
            first.wait_after_retract, other.wait_after_retract);
  first.retract_speed = other.retract_speed = detail::read_number(
      object, "retract_mm_per_min", 0, kGreatestSpeed, other.retract_speed);
}

unsigned read_pixels(const json& number) {
  const double pixels = number.get<double>();
  if (!(pixels >= 1 && pixels <= kMostPixels) || pixels != std::floor(pixels)) {
    throw std::runtime_error(
        fmt::format("pixels are from 1 to {}, not {}", kMostPixels, pixels));
  }
  return static_cast<unsigned>(pixels);
}

Vec2 read_plate(const json& object) {
  if (object.contains("pixels")) {
    throw std::runtime_error("plate_mm is for printers without pixels");
  }
  const Vec2 plate(object.at("plate_mm").at(0).get<double>(),
                   object.at("plate_mm").at(1).get<double>());
  const auto is_length = [](double mm) {
    return mm > 0 && mm <= kGreatestHeight;
  };
  if (!is_length(plate.x) || !is_length(plate.y)) {
    throw std::runtime_error("plate_mm must be positive");
  }
  return plate;
}

void read_panel(const json& object, Printer& printer) {
  printer.width = read_pixels(object.at("pixels").at(0));
  printer.height = read_pixels(object.at("pixels").at(1));
  printer.pixel = {object.at("pixel_mm").at(0).get<double>(),
                   object.at("pixel_mm").at(1).get<double>()};
  printer.right = read_direction(object.at("right"));
  printer.up = read_direction(object.at("up"));
  if (object.contains("nanodlp_pixels")) {
    printer.nanodlp_layout =
        read_layout(object.at("nanodlp_pixels"), printer.width);
  }
  const auto is_size = [](double mm) { return mm > 0 && mm <= kGreatestPixel; };
  if (!is_size(printer.pixel.x) || !is_size(printer.pixel.y)) {
    throw std::runtime_error("pixel_mm must be positive");
  }
  if (printer.right.x * printer.up.x + printer.right.y * printer.up.y != 0) {
    throw std::runtime_error("right and up are one direction");
  }
}

Printer read_printer(const json& object) {
  detail::require_members(
      object,
      {"name", "title", "source", "pixels", "pixel_mm", "right", "up",
       "plate_mm", "height_mm", "move_s", "lift_mm", "lift_mm_per_min",
       "retract_mm_per_min", "wait_before_lift_s", "wait_after_retract_s",
       "nanodlp_pixels", "reads", "ctb_version"});
  Printer printer;
  printer.name = detail::read_line(object, "name");
  printer.title = detail::read_line(object, "title", printer.name);
  printer.source = detail::read_line(object, "source", "");
  if (object.contains("plate_mm")) {
    printer.plate = read_plate(object);
  } else {
    read_panel(object, printer);
  }
  printer.build_height =
      detail::read_number(object, "height_mm", 0.001, kGreatestHeight, 0);
  printer.move_seconds =
      detail::read_number(object, "move_s", 0, kLongestMove, 0);
  read_moves(object, printer);
  if (object.contains("reads")) {
    for (const json& extension : object.at("reads")) {
      printer.reads.push_back(on_one_line(extension.get<std::string>()));
    }
  }
  printer.ctb_version = static_cast<unsigned>(
      detail::read_number(object, "ctb_version", 2, 4, 3));
  return printer;
}

std::string volume_text(Vec3 size) {
  return std::isinf(size.z) ? fmt::format("{:.6g} x {:.6g} mm", size.x, size.y)
                            : fmt::format("{:.6g} x {:.6g} x {:.6g} mm", size.x,
                                          size.y, size.z);
}

bool fits(Vec3 size, Vec3 volume) {
  return size.x <= volume.x && size.y <= volume.y && size.z <= volume.z;
}

// "it fits elegoo-saturn (192 x 120 x 200 mm) or …"
std::string larger_printers(Vec3 size) {
  const Vec3 turned(size.y, size.x, size.z);
  std::vector<Printer> larger = known_printers();
  std::erase_if(larger, [&](const Printer& other) {
    return other.build_height == 0 || (!fits(size, other.build_volume()) &&
                                       !fits(turned, other.build_volume()));
  });
  std::ranges::stable_sort(larger, {}, [](const Printer& other) {
    const Vec3 volume = other.build_volume();
    return volume.x * volume.y * volume.z;
  });
  if (larger.empty()) return "lamina knows no printer that is large enough";
  if (larger.size() > kMostNamed) larger.resize(kMostNamed);
  std::string words = "it fits";
  for (std::size_t i = 0; i < larger.size(); ++i) {
    words += fmt::format("{} {} ({})",
                         i == 0                   ? ""
                         : i + 1 == larger.size() ? " or"
                                                  : ",",
                         larger[i].name, volume_text(larger[i].build_volume()));
  }
  return words;
}

}  // namespace

Vec3 Printer::build_volume() const {
  const double z =
      build_height > 0 ? build_height : std::numeric_limits<double>::infinity();
  if (!has_panel()) return {plate, z};
  const Vec2 panel = Vec2(width, height) * pixel;
  return right.x != 0 ? Vec3(panel.x, panel.y, z) : Vec3(panel.y, panel.x, z);
}

std::vector<Printer> known_printers() {
  std::vector<Printer> printers;
  for (const std::string_view profile : detail::kPrinterProfiles) {
    printers.push_back(read_printer(json::parse(profile)));
  }
  return printers;
}

Printer find_printer(const std::string& name_or_file,
                     const FileAccess& access) {
  Printer printer;
  detail::read_profile(
      "printer", name_or_file, detail::kPrinterProfiles, access,
      [&](const json& object) { printer = read_printer(object); });
  return printer;
}

bool fits(const Printer& printer, Vec3 size) {
  return fits(size, printer.build_volume());
}

std::string too_large_text(const Printer& printer, Vec3 size) {
  return fmt::format(
      "The design is {:.6g} x {:.6g} x {:.6g} mm, larger than what {} builds: "
      "{}",
      size.x, size.y, size.z, printer.name,
      volume_text(printer.build_volume()));
}

TooLarge::TooLarge(const Printer& printer, Vec3 its_size)
    : GeometryError(fmt::format("{}; {}", too_large_text(printer, its_size),
                                larger_printers(its_size))),
      size(its_size) {}

}  // namespace lamina::slicer
