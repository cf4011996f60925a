// Reads layers back from the files of resin printers: Elegoo's .goo and
// ChiTuBox's .ctb, versions 2 to 4 (docs/formats.md). Each layer is a picture
// in runs; its contours are those of any image of a layer (panel_contours.h).

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "slicer/formats/detail/byte_order.h"
#include "slicer/formats/detail/panel_formats.h"
#include "slicer/formats/detail/reading.h"
#include "slicer/pixels/panel_contours.h"

namespace lamina::slicer {
namespace {

using BigReader = RecordReader<std::endian::big>;
using LittleReader = RecordReader<std::endian::little>;

constexpr std::string_view kGooBegin{"V3.0\x07\0\0\0DLP\0", 12};
constexpr std::uint64_t kGooPanel = 195310;  // the layer count and what follows
constexpr std::uint64_t kGooFirstLayer = 195470;

// Of a layer, up to the size of its data.
constexpr std::uint64_t kGooLayerRecord = 66;

// Heights in float32 say no more than this.
constexpr double kStepsPerMm = 1e4;
// Nor do the sizes of panels of the size of a pixel.
constexpr double kPixelStepsPerMm = 1e6;

// The pixels of one layer, filled run by run.
class Picture {
 public:
  explicit Picture(const Printer& printer)
      : pixels_(std::size_t{printer.width} * printer.height) {}

  void begin() { filled_ = 0; }
  void add(std::uint8_t grey, std::uint64_t count) {
    if (count > pixels_.size() - filled_) {
      throw std::runtime_error("its runs cover more than the picture");
    }
    std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(filled_), count,
                grey);
    filled_ += count;
  }
  const std::vector<std::uint8_t>& finish() const {
    if (filled_ != pixels_.size()) {
      throw std::runtime_error(fmt::format("its runs cover {} of {} pixels",
                                           filled_, pixels_.size()));
    }
    return pixels_;
  }

 private:
  std::vector<std::uint8_t> pixels_;
  std::size_t filled_ = 0;
};

// Throws std::runtime_error where these are no sizes.
void set_panel(Printer& printer, std::uint32_t columns, std::uint32_t rows,
               Vec2 mm) {
  if (columns == 0 || rows == 0 || columns > kMostPixels / rows) {
    throw std::runtime_error(
        fmt::format("a panel of {} x {} pixels cannot be", columns, rows));
  }
  printer.width = columns;
  printer.height = rows;
  const auto rounded = [](double length) {
    return std::round(length * kPixelStepsPerMm) / kPixelStepsPerMm;
  };
  printer.pixel = {rounded(mm.x / columns), rounded(mm.y / rows)};
  if (!(printer.pixel.x > 0 && printer.pixel.y > 0)) {
    throw std::runtime_error("the size of a pixel must be positive");
  }
}

Layer layer_below(double top, double thickness) {
  const auto rounded = [](double z) {
    return std::round(z * kStepsPerMm) / kStepsPerMm;
  };
  if (!(thickness > 0) || !std::isfinite(top)) {
    throw std::runtime_error("its height or thickness cannot be");
  }
  Layer layer;
  layer.top = rounded(top);
  layer.bottom = rounded(top - thickness);
  layer.section_z = (layer.bottom + layer.top) / 2;
  return layer;
}

// data  without the mark before it and the sum behind it
// full  the grey of a pixel that is wholly covered
void read_goo_runs(std::string_view data, unsigned full, Picture& picture) {
  BigReader reader(data, 0);
  unsigned grey = 0;
  while (!reader.is_at_end()) {
    const unsigned head = reader.u8();
    const unsigned kind = head >> 6U;
    std::uint64_t count = 1;
    if (kind == 2) {
      const unsigned step = head & 15U;
      grey = (head & 32U) != 0 ? grey - step : grey + step;
      if ((head & 16U) != 0) count = reader.u8();
    } else {
      grey = kind == 0 ? 0 : kind == 3 ? full : reader.u8();
      count = 0;
      for (unsigned more = head >> 4U & 3U; more > 0; --more) {
        count = count << 8U | reader.u8();
      }
      count = count << 4U | (head & 15U);
    }
    if (grey > full) throw std::runtime_error("its grey is out of range");
    picture.add(static_cast<std::uint8_t>(grey * 255 / full), count);
  }
}

void read_ctb_runs(std::string_view data, Picture& picture) {
  LittleReader reader(data, 0);
  while (!reader.is_at_end()) {
    const unsigned head = reader.u8();
    std::uint64_t count = 1;
    if ((head & 0x80U) != 0) {
      const auto first = reader.u8();
      const auto more = static_cast<unsigned>(std::countl_one(first));
      if (more > 3) throw std::runtime_error("the length of a run cannot be");
      count = first & (0x7FU >> more);
      for (unsigned i = 0; i < more; ++i) count = count << 8U | reader.u8();
    }
    const unsigned grey = head & 0x7FU;
    picture.add(static_cast<std::uint8_t>(grey == 0 ? 0 : grey << 1U | 1U),
                count);
  }
}

// Calls read(), and fails with the file's name where it throws.
//
// what  is read, for the message: "layer 3: "
template <typename Read>
void read_part(const std::string& path, const std::string& what,
               const Read& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    fail_to_read(path, what + error.what());
  }
}

std::string layer_words(std::uint32_t index) {
  return fmt::format("layer {}: ", index + 1);
}

}  // namespace

LayerFileFacts read_goo(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  const std::string bytes = read_whole(path, access);
  if (!bytes.starts_with(kGooBegin)) {
    fail_to_read(path, "it does not begin as a .goo file of version 3 does");
  }
  Printer printer;
  std::uint32_t count = 0;
  double thickness = 0;
  std::uint64_t first = 0;
  unsigned full = 15;
  std::string writer;
  read_part(path, "", [&] {
    BigReader header(bytes, kGooPanel);
    count = header.u32();
    const std::uint32_t columns = header.u16();
    const std::uint32_t rows = header.u16();
    if (header.u8() != 0) printer.right = {-1, 0};
    if (header.u8() != 0) printer.up = {0, -1};
    const double width = header.f32();
    const double height = header.f32();
    set_panel(printer, columns, rows, {width, height});
    header.skip(4);
    thickness = header.f32();
    BigReader rest(bytes, kGooFirstLayer);
    first = rest.u32();
    if (rest.u8() != 0) full = 255;
    const auto text = [&](std::uint64_t at, std::uint64_t size) {
      const std::string_view field = BigReader(bytes, at).raw(size);
      return on_one_line(field.substr(0, field.find('\0')));
    };
    writer = text(12, 32) + " " + text(44, 24);
  });
  BigReader reader(bytes, first);
  Picture picture(printer);
  for (std::uint32_t i = 0; i < count; ++i) {
    Layer layer;
    read_part(path, layer_words(i), [&] {
      reader.skip(6);
      layer = layer_below(reader.f32(), thickness);
      reader.skip(kGooLayerRecord - 10);
      const std::string_view data = reader.raw(reader.u32());
      reader.skip(2);
      if (data.size() < 2 || data.front() != '\x55') {
        throw std::runtime_error("its data do not begin as they must");
      }
      const std::string_view runs = data.substr(1, data.size() - 2);
      if (goo_checksum(runs) != data.back()) {
        throw std::runtime_error("its checksum is not that of its data");
      }
      picture.begin();
      read_goo_runs(runs, full, picture);
      layer.contours = contours_on_panel(picture.finish(), printer);
    });
    take(layer);
  }
  return panel_file_facts("Elegoo GOO", count, printer, writer);
}

LayerFileFacts read_ctb(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  const std::string bytes = read_whole(path, access);
  Printer printer;
  std::uint32_t version = 0;
  std::uint32_t count = 0;
  std::uint32_t key = 0;
  std::uint32_t table = 0;
  double thickness = 0;
  read_part(path, "", [&] {
    LittleReader header(bytes, 0);
    const std::uint32_t magic = header.u32();
    if (magic == kCtbMagicEncrypted) {
      throw std::runtime_error(
          "it is encrypted; UVtools converts it ('UVtoolsCmd convert')");
    }
    version = header.u32();
    if ((magic != kCtbMagic && magic != kCtbMagic4) || version < 2 ||
        version > 5) {
      throw std::runtime_error(
          "it does not begin as a .ctb file of version 2 to 5 does");
    }
    const double width = header.f32();
    const double height = header.f32();
    header.skip(4 + 8 + 4);
    thickness = header.f32();
    header.skip(4 * 4);
    const std::uint32_t columns = header.u32();
    const std::uint32_t rows = header.u32();
    set_panel(printer, columns, rows, {width, height});
    header.skip(4);
    table = header.u32();
    count = header.u32();
    header.skip(8);
    if (header.u32() != 0) printer.right = {-1, 0};
    header.skip(4 * 4);
    key = header.u32();
  });
  LittleReader entries(bytes, table);
  Picture picture(printer);
  for (std::uint32_t i = 0; i < count; ++i) {
    Layer layer;
    read_part(path, layer_words(i), [&] {
      layer = layer_below(entries.f32(), thickness);
      entries.skip(8);
      const std::uint64_t place = entries.u32();
      const std::uint64_t size = entries.u32();
      const std::uint64_t page = entries.u32();
      entries.skip(12);
      std::string data(LittleReader(bytes, page << 32U | place).raw(size));
      mask_ctb_layer(key, i, data);
      picture.begin();
      read_ctb_runs(data, picture);
      layer.contours = contours_on_panel(picture.finish(), printer);
    });
    take(layer);
  }
  return panel_file_facts(fmt::format("ChiTuBox CTB, version {}", version),
                          count, printer, "");
}

}  // namespace lamina::slicer
