// Writes Elegoo's .goo, V3.0 (docs/formats.md): a header with two previews,
// then one record a layer with its pixels in runs.
//
// Source: elegooofficial/GOO, Goo Format Spec V1.2; the end of the file as
// mslicer and UVtools write it. Departure: runs are never differences to the
// grey before, which some firmware may not take.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/version.h"
#include "slicer/formats/detail/byte_order.h"
#include "slicer/formats/detail/image_stack_writer.h"
#include "slicer/formats/detail/panel_formats.h"
#include "slicer/formats/detail/writers.h"
#include "slicer/pixels/grey_runs.h"

namespace lamina::slicer {
namespace {

using GooRecord = RecordWriter<std::endian::big>;

constexpr std::size_t kGooHeaderSize = 195477;
constexpr std::string_view kMagic{"\x07\0\0\0DLP\0", 8};
constexpr std::string_view kDelimiter = "\r\n";

void append_goo_run(std::string& bytes, std::uint8_t grey,
                    std::uint64_t count) {
  const unsigned kind = grey == 0 ? 0 : grey == 255 ? 3 : 1;
  unsigned more = 0;  // bytes of the length
  while (count >> (4 + 8 * more) != 0) ++more;
  bytes += static_cast<char>(kind << 6 | more << 4 | (count & 15));
  if (kind == 1) bytes += static_cast<char>(grey);
  while (more > 0) bytes += static_cast<char>(count >> (4 + 8 * --more));
}

class GooWriter : public ImageStackWriter {
 public:
  GooWriter(const WriterOptions& options, const std::string& path,
            TemporaryFiles& files)
      : ImageStackWriter(options, path), file_(OutputFile::open(path, files)) {
    file_.write(std::string(kGooHeaderSize, '\0'));
  }

  std::string encode(const Layer& layer) const override {
    std::string bytes = "\x55";
    RunJoiner joiner([&](std::uint8_t grey, std::uint64_t count) {
      append_goo_run(bytes, grey, count);
    });
    const Printer& printer = stack().printer;
    visit_runs(layer.contours, printer.width, printer.height, map(), 0,
               [&](std::uint8_t grey, std::uint64_t count) {
                 joiner.add(grey, count);
               });
    joiner.finish();
    return bytes += goo_checksum(std::string_view(bytes).substr(1));
  }

  void finish(Diagnostics& /*diagnostics*/) override {
    file_.write(std::string(3, '\0'));
    file_.write(kMagic);
    file_.patch(0, header());
  }
  void commit() override { file_.commit(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  void add_image(std::string_view bytes) override {
    const std::size_t index = stack().layers.size();
    const PlatformMoves& moves = moves_of(stack().printer, index);
    GooRecord record;
    record.u16(0);  // no pause
    record.f32(0);
    record.f32(stack().layer_thickness * static_cast<double>(index + 1));
    record.f32(stack().exposure.of(index));
    record.f32(0);  // off time: the waits count
    record.f32(moves.wait_before_lift);
    record.f32(0);
    record.f32(moves.wait_after_retract);
    record.f32(moves.lift);
    record.f32(moves.lift_speed);
    record.zeros(8);  // no second stage
    record.f32(moves.lift);
    record.f32(moves.retract_speed);
    record.zeros(8);
    record.u16(kFullPower);
    record.raw(kDelimiter);
    record.u32(bytes.size());
    file_.write(record.bytes());
    file_.write(bytes);
    file_.write(kDelimiter);
  }

  void put_preview(GooRecord& record, unsigned side) const {
    const auto pixels = draw_preview(side, side);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
      record.u16(pixels[i] >> 3U << 11U | pixels[i + 1] >> 2U << 5U |
                 pixels[i + 2] >> 3U);
    }
    record.raw(kDelimiter);
  }

  std::string header() const {
    const Printer& printer = stack().printer;
    const Exposure& exposure = stack().exposure;
    const PlatformMoves& first = printer.first_moves;
    const PlatformMoves& other = printer.moves;
    const std::size_t layers = stack().layers.size();
    const double height = stack().layer_thickness * static_cast<double>(layers);
    GooRecord record;
    record.raw("V3.0");
    record.raw(kMagic);
    record.text("lamina", 32);
    record.text(version(), 24);
    record.text("1980-01-01 00:00:00", 24);  // the same bytes at any time
    record.text(printer.title, 32);
    record.text(printer.name, 32);
    record.text(stack().material, 32);
    for (const unsigned level : {4U, 0U, 0U}) record.u16(level);
    put_preview(record, 116);
    put_preview(record, 290);
    record.u32(layers);
    record.u16(printer.width);
    record.u16(printer.height);
    record.u8(printer.is_mirrored());
    record.u8(0);
    record.f32(printer.width * printer.pixel.x);
    record.f32(printer.height * printer.pixel.y);
    record.f32(printer.build_height > 0 ? printer.build_height : height);
    record.f32(stack().layer_thickness);
    record.f32(exposure.layer);
    record.u8(1);  // the waits count
    record.f32(0);
    for (const PlatformMoves& moves : {first, other}) {
      record.f32(moves.wait_before_lift);
      record.f32(0);
      record.f32(moves.wait_after_retract);
    }
    record.f32(exposure.first);
    record.u32(std::min(kFirstLayers, layers));
    for (const PlatformMoves& moves : {first, other}) {
      record.f32(moves.lift);
      record.f32(moves.lift_speed);
    }
    for (const PlatformMoves& moves : {first, other}) {
      record.f32(moves.lift);
      record.f32(moves.retract_speed);
    }
    record.zeros(8 * 4);  // no second stage
    record.u16(kFullPower);
    record.u16(kFullPower);
    record.u8(0);  // the header's values count
    record.u32(
        static_cast<std::uint64_t>(print_seconds(printer, exposure, layers)));
    record.f32(stack().volume);
    record.zeros(8);  // weight and price are not known
    record.zeros(8);
    record.u32(kGooHeaderSize);
    record.u8(1);  // grey is 0 to 255
    record.u16(kFadeLayers);
    return record.bytes();
  }

  OutputFile file_;
};

}  // namespace

std::unique_ptr<LayerWriter> make_goo_writer(const WriterOptions& options,
                                             const std::string& path,
                                             TemporaryFiles& files) {
  return std::make_unique<GooWriter>(options, path, files);
}

}  // namespace lamina::slicer
