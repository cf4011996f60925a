// Writes ChiTuBox's .ctb, versions 2 to 4, not encrypted (docs/formats.md):
// records that are found by their places in the file. The images come first,
// because what is behind them is known last.
//
// Source: cbiffle/catibo, cbddlp-ctb.adoc; ezrec/uv3dp for version 3, UVtools
// for version 4.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slicer/formats/detail/byte_order.h"
#include "slicer/formats/detail/image_stack_writer.h"
#include "slicer/formats/detail/panel_formats.h"
#include "slicer/formats/detail/writers.h"
#include "slicer/pixels/grey_runs.h"

namespace lamina::slicer {
namespace {

using CtbRecord = RecordWriter<std::endian::little>;

constexpr std::size_t kCtbHeaderSize = 112;
constexpr std::size_t kSlicerSize = 76;
constexpr std::size_t kTableEntrySize = 36;
constexpr std::size_t kLayerRecordSize = 84;  // of version 3 and above
constexpr std::size_t kNoticeSize = 320;
// Any key but 0 is as good as another; one alone gives the same bytes always.
constexpr std::uint32_t kKey = 0x6C616D69;

void append_ctb_run(std::string& bytes, std::uint8_t grey,
                    std::uint64_t count) {
  bytes += static_cast<char>(count > 1 ? grey | 0x80 : grey);
  if (count == 1) return;
  if (count < 1U << 7) {
    bytes += static_cast<char>(count);
    return;
  }
  unsigned more = 1;
  while (count >> (7 * (more + 1)) != 0) ++more;
  constexpr std::array<unsigned, 4> kHeads = {0, 0x80, 0xC0, 0xE0};
  bytes += static_cast<char>(kHeads[more] | count >> (8 * more));
  while (more > 0) bytes += static_cast<char>(count >> (8 * --more));
}

class CtbWriter : public ImageStackWriter {
 public:
  CtbWriter(const WriterOptions& options, const std::string& path,
            TemporaryFiles& files)
      : ImageStackWriter(options, path),
        version_(options.printer.ctb_version),
        file_(OutputFile::open(path, files)) {
    file_.write(std::string(kCtbHeaderSize, '\0'));
  }

  std::string encode(const Layer& layer) const override {
    std::string bytes;
    RunJoiner joiner([&](std::uint8_t grey, std::uint64_t count) {
      append_ctb_run(bytes, grey, count);
    });
    const Printer& printer = stack().printer;
    visit_runs(layer.contours, printer.width, printer.height, map(), 0,
               [&](std::uint8_t grey, std::uint64_t count) {
                 joiner.add(grey >> 1U, count);
               });
    joiner.finish();
    return bytes;
  }

  void finish(Diagnostics& /*diagnostics*/) override {
    const std::uint64_t table = file_.size();
    file_.write(table_.bytes());
    const std::uint64_t big = add_preview(400, 300);
    const std::uint64_t small = add_preview(200, 125);
    const std::uint64_t parameters = file_.size();
    add_parameters();
    const std::uint64_t slicer = file_.size();
    add_slicer();
    if (file_.size() >> 32U != 0) {
      throw FileError(".ctb has no room for more than 4 GB");
    }
    file_.patch(0, header(table, big, small, parameters, slicer));
  }
  void commit() override { file_.commit(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  void add_image(std::string_view bytes) override {
    const std::size_t index = stack().layers.size();
    std::string masked(bytes);
    mask_ctb_layer(kKey, static_cast<std::uint32_t>(index), masked);
    const bool has_record = version_ > 2;
    const std::size_t record_size = has_record ? kLayerRecordSize : 0;
    CtbRecord entry;
    entry.f32(stack().layer_thickness * static_cast<double>(index + 1));
    entry.f32(stack().exposure.of(index));
    entry.f32(0);  // off time
    entry.u32(file_.size() + record_size);
    entry.u32(masked.size());
    entry.u32(0);
    entry.u32(has_record ? kLayerRecordSize : kTableEntrySize);
    entry.zeros(8);
    table_.raw(entry.bytes());
    if (has_record) file_.write(layer_record(index, entry, masked.size()));
    file_.write(masked);
  }

  std::string layer_record(std::size_t index, const CtbRecord& entry,
                           std::size_t size) const {
    const PlatformMoves& moves = moves_of(stack().printer, index);
    CtbRecord record;
    record.raw(entry.bytes());
    record.u32(kLayerRecordSize + size);
    record.f32(moves.lift);
    record.f32(moves.lift_speed);
    record.zeros(8);  // no second stage
    record.f32(moves.retract_speed);
    record.zeros(8);
    record.f32(moves.wait_before_lift);
    record.f32(0);
    record.f32(moves.wait_after_retract);
    record.f32(kFullPower);
    return record.bytes();
  }

  // Returns where the picture's record is.
  std::uint64_t add_preview(unsigned width, unsigned height) {
    constexpr std::uint32_t kRepeats = 0x20;
    constexpr std::uint64_t kMostRepeats = 0xFFF;
    const auto pixels = draw_preview(width, height);
    const auto color_at = [&](std::size_t i) {
      return static_cast<std::uint32_t>(pixels[i] >> 3U << 11U |
                                        pixels[i + 1] >> 3U << 6U |
                                        pixels[i + 2] >> 3U);
    };
    CtbRecord words;
    for (std::size_t i = 0; i < pixels.size();) {
      const std::uint32_t color = color_at(i);
      std::uint64_t count = 1;
      while (count < kMostRepeats && i + 3 * count < pixels.size() &&
             color_at(i + 3 * count) == color) {
        ++count;
      }
      words.u16(count > 1 ? color | kRepeats : color);
      if (count > 1) {
        words.u16(0x3000U | static_cast<std::uint32_t>(count - 1));
      }
      i += 3 * count;
    }
    const std::uint64_t place = file_.size();
    CtbRecord record;
    record.u32(width);
    record.u32(height);
    record.u32(place + 32);
    record.u32(words.size());
    record.zeros(16);
    file_.write(record.bytes());
    file_.write(words.bytes());
    return place;
  }

  std::size_t first_layers() const {
    return std::min(kFirstLayers, stack().layers.size());
  }

  void add_parameters() {
    const PlatformMoves& first = stack().printer.first_moves;
    const PlatformMoves& other = stack().printer.moves;
    CtbRecord record;
    for (const PlatformMoves& moves : {first, other}) {
      record.f32(moves.lift);
      record.f32(moves.lift_speed);
    }
    record.f32(other.retract_speed);
    record.f32(stack().volume / 1000);
    record.zeros(8);  // weight and price are not known
    record.zeros(8);  // off times
    record.u32(first_layers());
    record.zeros(12);
    record.u32(version_ == 2 ? 0x1234 : 0);
    file_.write(record.bytes());
  }

  // With all that stands behind it.
  void add_slicer() {
    const std::string& name = stack().printer.title;
    const std::uint64_t name_place = file_.size() + kSlicerSize;
    const std::uint64_t notice_place = name_place + name.size();
    CtbRecord record;
    record.zeros(24);  // no second stage
    record.f32(0);
    record.u32(name_place);
    record.u32(name.size());
    record.u8(15);  // anti-aliased
    record.u16(0);
    record.u8(static_cast<std::uint8_t>(version_ << 4U));  // layers have values
    record.u32(0);  // the same bytes at any time
    record.u32(4);  // levels, for information
    record.u32(version_ < 4 ? 0x01060300 : 0x01090000);
    record.f32(stack().printer.moves.wait_after_retract);
    record.f32(0);
    record.u32(kFadeLayers);
    record.u32(version_ < 4 ? 0 : notice_place + kNoticeSize);
    record.zeros(8);
    record.raw(name);
    if (version_ == 4) add_version_4(record, notice_place);
    file_.write(record.bytes());
  }

  void add_version_4(CtbRecord& record, std::uint64_t notice_place) const {
    const PlatformMoves& moves = stack().printer.moves;
    record.zeros(kNoticeSize);
    record.f32(stack().printer.first_moves.retract_speed);
    record.f32(0);
    for (int i = 0; i < 2; ++i) {
      record.u32(0);
      record.f32(4);
    }
    record.f32(moves.wait_after_retract);
    record.f32(0);
    record.f32(moves.wait_before_lift);
    record.zeros(12);
    record.u32(5);
    record.u32(stack().layers.size() - 1);
    record.zeros(16);
    record.u32(notice_place);
    record.u32(kNoticeSize);
    record.zeros(4 + 380);
  }

  std::string header(std::uint64_t table, std::uint64_t big,
                     std::uint64_t small, std::uint64_t parameters,
                     std::uint64_t slicer) const {
    const Printer& printer = stack().printer;
    const Exposure& exposure = stack().exposure;
    const std::size_t layers = stack().layers.size();
    const double height = stack().layer_thickness * static_cast<double>(layers);
    CtbRecord record;
    record.u32(version_ < 4 ? kCtbMagic : kCtbMagic4);
    record.u32(version_);
    record.f32(printer.width * printer.pixel.x);
    record.f32(printer.height * printer.pixel.y);
    record.f32(printer.build_height > 0 ? printer.build_height : height);
    record.zeros(8);
    record.f32(height);
    record.f32(stack().layer_thickness);
    record.f32(exposure.layer);
    record.f32(exposure.first);
    record.f32(0);
    record.u32(first_layers());
    record.u32(printer.width);
    record.u32(printer.height);
    record.u32(big);
    record.u32(table);
    record.u32(layers);
    record.u32(small);
    record.u32(
        static_cast<std::uint64_t>(print_seconds(printer, exposure, layers)));
    record.u32(printer.is_mirrored());
    record.u32(parameters);
    record.u32(slicer - parameters);
    record.u32(1);  // level sets
    record.u16(kFullPower);
    record.u16(kFullPower);
    record.u32(kKey);
    record.u32(slicer);
    record.u32(kSlicerSize);
    return record.bytes();
  }

  unsigned version_;
  OutputFile file_;
  CtbRecord table_;
};

}  // namespace

std::unique_ptr<LayerWriter> make_ctb_writer(const WriterOptions& options,
                                             const std::string& path,
                                             TemporaryFiles& files) {
  return std::make_unique<CtbWriter>(options, path, files);
}

}  // namespace lamina::slicer
