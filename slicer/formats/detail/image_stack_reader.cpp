// Reads layers back from images (docs/formats.md): folders, SL1 and NanoDLP
// archives. A contour runs where the grey is half, so places are true to a
// tenth of a pixel; the middle of the panel is at x = y = 0.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file/format_error.h"
#include "base/file/png_image.h"
#include "base/file/zip.h"
#include "base/text.h"
#include "slicer/formats/detail/image_stack.h"
#include "slicer/formats/detail/reading.h"
#include "slicer/pixels/panel_contours.h"

namespace lamina::slicer {
namespace {

using ReadJson = nlohmann::json;

constexpr std::string_view kImageEnding = ".png";
constexpr std::string_view kDigits = "0123456789";

// The name of a job may end in digits before those of the layer: only so many
// are looked at.
constexpr std::size_t kMostDigits = 9;

struct ImageFile {
  std::string name;
  double bottom = 0;
  double top = 0;
  double section_z = 0;
};

// What the texts of a stack say.
struct StackFacts {
  std::string format;
  std::string writer;
  Printer printer;
  std::vector<ImageFile> images;
};

// The contents of a folder or an archive.
struct Source {
  std::vector<std::string> names;
  std::function<std::optional<std::string>(const std::string&)> read;
};

class ImageStackReader {
 public:
  ImageStackReader(const std::string& path, Source source)
      : path_(path), source_(std::move(source)) {}

  LayerFileFacts read(const TakeLayer& take) {
    const StackFacts stack = read_facts();
    for (const ImageFile& image : stack.images) {
      Layer layer;
      layer.bottom = image.bottom;
      layer.top = image.top;
      layer.section_z = image.section_z;
      layer.contours = contours_of(image.name, stack.printer);
      take(layer);
    }
    return panel_file_facts(stack.format, stack.images.size(), stack.printer,
                            stack.writer);
  }

 private:
  std::string require_text(const std::string& name) const {
    std::optional<std::string> text = source_.read(name);
    if (!text) fail_to_read(path_, fmt::format("it holds no {}", name));
    return *std::move(text);
  }

  StackFacts read_facts() const {
    try {
      if (has("config.ini")) return sl1_facts();
      if (has("slicer.json")) return nanodlp_facts();
      return folder_facts();
    } catch (const ReadJson::exception& error) {
      const std::string_view words = error.what();
      fail_to_read(path_, words.substr(words.find("] ") + 2));
    }
  }
  bool has(std::string_view name) const {
    return std::ranges::find(source_.names, name) != source_.names.end();
  }

  // "name = value" by lines.
  std::map<std::string, std::string> settings(const std::string& name) const {
    std::map<std::string, std::string> values;
    const std::string text = require_text(name);
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      const std::size_t equals = line.find('=');
      if (equals == std::string_view::npos) continue;
      values.try_emplace(std::string(trim(line.substr(0, equals))),
                         trim(line.substr(equals + 1)));
    }
    return values;
  }
  double number_of(const std::map<std::string, std::string>& values,
                   const std::string& name) const {
    const auto found = values.find(name);
    const auto number = found == values.end() ? std::optional<double>()
                                              : parse_number(found->second);
    if (!number || !(*number > 0)) {
      fail_to_read(
          path_, fmt::format("expected {} to be a positive number, "
                             "not '{}'",
                             name, found == values.end() ? "" : found->second));
    }
    return *number;
  }

  // The images of an archive by the numbers that their names end in, without
  // those in folders: these show the whole. Throws FileError where one lacks.
  //
  // named_by_number  names are numbers, and other images do not show layers
  std::vector<std::string> numbered_images(bool named_by_number) const {
    std::vector<std::pair<std::uint64_t, std::string>> images;
    for (const std::string& name : source_.names) {
      if (!name.ends_with(kImageEnding)) continue;
      if (name.find('/') != std::string::npos) continue;
      std::string_view digits = name;
      digits.remove_suffix(kImageEnding.size());
      digits.remove_prefix(digits.find_last_not_of(kDigits) + 1);
      const bool is_number = digits.size() + kImageEnding.size() == name.size();
      if (named_by_number && !is_number) continue;
      if (digits.empty()) {
        fail_to_read(
            path_,
            fmt::format("the name of {} does not end in a number", name));
      }
      digits.remove_prefix(digits.size() -
                           std::min(digits.size(), kMostDigits));
      std::uint64_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      images.emplace_back(number, name);
    }
    if (images.empty()) fail_to_read(path_, "it holds no images");
    std::ranges::sort(images);
    std::vector<std::string> names;
    for (auto& [number, name] : images) {
      const bool is_next = names.empty()
                               ? !named_by_number || number <= 1
                               : number == images[names.size() - 1].first + 1;
      if (!is_next) {
        fail_to_read(path_,
                     fmt::format("the image before {} is missing", name));
      }
      names.push_back(std::move(name));
    }
    return names;
  }

  // Images of layers of one thickness.
  //
  // stated  how many there are, as `source` says; nothing where it does not
  std::vector<ImageFile> images_of(std::vector<std::string> names,
                                   double thickness,
                                   std::optional<double> stated,
                                   std::string_view source) const {
    if (stated && *stated != static_cast<double>(names.size())) {
      fail_to_read(path_, fmt::format("{} counts {:g} layers, there are {} "
                                      "images",
                                      source, *stated, names.size()));
    }
    std::vector<ImageFile> images;
    for (std::string& name : names) {
      const auto i = static_cast<double>(images.size());
      images.push_back({std::move(name), i * thickness, (i + 1) * thickness,
                        (i + 0.5) * thickness});
    }
    return images;
  }

  StackFacts sl1_facts() const {
    const auto config = settings("config.ini");
    StackFacts stack;
    stack.format = "SL1";
    if (const auto writer = config.find("prusaSlicerVersion");
        writer != config.end()) {
      stack.writer = writer->second;
    }
    stack.images =
        images_of(numbered_images(false), number_of(config, "layerHeight"),
                  sl1_count(config), "config.ini");
    set_sl1_panel(stack.printer);
    return stack;
  }

  // How many layers there are. (Those that numFade counts are among them.)
  static std::optional<double> sl1_count(
      const std::map<std::string, std::string>& config) {
    std::optional<double> count;
    for (const char* const name : {"numFast", "numSlow"}) {
      const auto found = config.find(name);
      if (found == config.end()) continue;
      if (const auto number = parse_number(found->second)) {
        count = count.value_or(0) + *number;
      }
    }
    return count;
  }

  // PrusaSlicer counts the long side first, in portrait as well.
  void set_sl1_panel(Printer& printer) const {
    printer = find_printer("prusa-sl1");
    if (!has("prusaslicer.ini")) return;
    const auto values = settings("prusaslicer.ini");
    const auto is = [&](const char* name, std::string_view value) {
      const auto found = values.find(name);
      return found != values.end() && found->second == value;
    };
    const double columns = number_of(values, "display_pixels_x");
    const double rows = number_of(values, "display_pixels_y");
    const Vec2 pixel(number_of(values, "display_width") / columns,
                     number_of(values, "display_height") / rows);
    const bool is_portrait = is("display_orientation", "portrait");
    const bool is_mirrored = is("display_mirror_x", "1");
    printer.width = to_pixels(is_portrait ? rows : columns);
    printer.height = to_pixels(is_portrait ? columns : rows);
    printer.pixel = is_portrait ? Vec2(pixel.y, pixel.x) : pixel;
    const double side = is_mirrored ? -1 : 1;
    if (is_portrait) {
      printer.right = {0, -side};
      printer.up = {1, 0};
    } else {
      printer.right = {side, 0};
      printer.up = {0, is("display_mirror_y", "1") ? -1.0 : 1.0};
    }
  }

  unsigned to_pixels(double number) const {
    if (number != std::floor(number) || number < 1 || number > 65536) {
      fail_to_read(path_, fmt::format("{:g} is no number of pixels", number));
    }
    return static_cast<unsigned>(number);
  }

  StackFacts nanodlp_facts() const {
    const ReadJson slicer = ReadJson::parse(require_text("slicer.json"));
    StackFacts stack;
    stack.format = "NanoDLP";
    stack.printer.width = to_pixels(slicer.at("PWidth").get<double>());
    stack.printer.height = to_pixels(slicer.at("PHeight").get<double>());
    stack.printer.pixel = {slicer.at("XPixelSize").get<double>(),
                           slicer.at("YPixelSize").get<double>()};
    if (slicer.value("ImageMirror", 0) != 0) stack.printer.right = {-1, 0};
    if (has("meta.json")) {
      stack.writer =
          ReadJson::parse(require_text("meta.json")).value("Program", "");
    }
    std::optional<double> count;
    if (has("plate.json")) {
      const ReadJson plate = ReadJson::parse(require_text("plate.json"));
      if (plate.contains("LayersCount")) {
        count = plate.at("LayersCount").get<double>();
      }
    }
    stack.images = images_of(numbered_images(true),
                             slicer.at("Thickness").get<double>() / 1000, count,
                             "plate.json");
    require_pixel_size(stack.printer);
    return stack;
  }

  StackFacts folder_facts() const {
    const ReadJson index = ReadJson::parse(require_text(kFolderContents));
    StackFacts stack;
    stack.format = "folder of images";
    stack.writer = index.value("software", "");
    stack.printer.width = to_pixels(index.at("pixels").at(0).get<double>());
    stack.printer.height = to_pixels(index.at("pixels").at(1).get<double>());
    stack.printer.pixel = {index.at("pixel_mm").at(0).get<double>(),
                           index.at("pixel_mm").at(1).get<double>()};
    require_pixel_size(stack.printer);
    for (const ReadJson& image : index.at("layers")) {
      const double z = image.at("z").get<double>();
      const double half = image.at("thickness").get<double>() / 2;
      stack.images.push_back(
          {image.at("file").get<std::string>(), z - half, z + half, z});
    }
    return stack;
  }

  void require_pixel_size(const Printer& printer) const {
    if (printer.pixel.x > 0 && printer.pixel.y > 0) return;
    fail_to_read(path_, "the size of a pixel must be positive");
  }

  plane::Contours contours_of(const std::string& name,
                              const Printer& printer) const {
    const std::string bytes = require_text(name);
    PngImage image;
    try {
      image = read_png_image(
          bytes, PngChannels::kStored,
          [&](std::size_t columns, std::size_t rows) {
            if (columns > kMostPixels / std::max<std::size_t>(rows, 1)) {
              throw FormatError("PNG: too many pixels");
            }
          });
    } catch (const FormatError& error) {
      fail_to_read(path_, fmt::format("{}: {}", name, error.what()));
    }
    // Three grey pixels of a panel may be one of the image.
    const std::size_t columns = image.columns * image.channels;
    if (columns != printer.width || image.rows != printer.height) {
      fail_to_read(path_, fmt::format("{} has {} x {} pixels, not {} x {}",
                                      name, columns, image.rows, printer.width,
                                      printer.height));
    }
    return contours_on_panel(image.pixels, printer);
  }

  const std::string path_;
  const Source source_;
};

}  // namespace

LayerFileFacts read_image_archive(const std::string& path,
                                  const TakeLayer& take,
                                  const FileAccess& access) {
  const std::string bytes = read_whole(path, access);
  try {
    const ZipArchive archive = ZipArchive::open(bytes);
    return ImageStackReader(path, {archive.names(),
                                   [&](const std::string& name) {
                                     return archive.read(name);
                                   }})
        .read(take);
  } catch (const FormatError& error) {
    fail_to_read(path, error.what());
  }
}

LayerFileFacts read_image_folder(const std::string& path, const TakeLayer& take,
                                 const FileAccess& access) {
  return ImageStackReader(path, {{},
                                 [&](const std::string& name) {
                                   return access.read(path + "/" + name);
                                 }})
      .read(take);
}

bool is_image_folder(const std::string& path, const FileAccess& access) {
  return access.read(path + "/" + kFolderContents).has_value();
}

}  // namespace lamina::slicer
