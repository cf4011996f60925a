// Writes layers as images for the panels of resin printers: a folder of PNG
// files, Prusa's SL1 archive, or NanoDLP's (docs/formats.md).
//
// The grey of a pixel is the share of it that the layer covers, by area. The
// middle of the design's box stands in the middle of the panel.

#include "slicer/formats/detail/image_stack_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "base/diagnostic.h"
#include "base/file/output_folder.h"
#include "base/file/zip_output.h"
#include "base/text.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/formats/detail/writers.h"
#include "slicer/pixels/png_encoder.h"

namespace lamina::slicer {
namespace {

// A part as large as the panel fits, whatever rounding its numbers saw.
constexpr double kSlack = 1e-3;  // [pixels]

// The name of the print job, which printers show: "ring" of "out/ring.sl1".
// It stands in lines of settings, so it is one line of UTF-8 itself.
std::string job_name(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  name.resize(std::min(name.size(), name.rfind('.')));
  return name.empty() || name == "-" ? "lamina" : on_one_line(name);
}

// The layer's thickness without the rounding of its heights.
double thickness_of(const Layer& layer) {
  constexpr double kPerMm = 1e9;
  return std::round((layer.top - layer.bottom) * kPerMm) / kPerMm;
}

// Images and texts by name.
class NamedStackWriter : public ImageStackWriter {
 public:
  using ImageStackWriter::ImageStackWriter;

  void finish(Diagnostics& /*diagnostics*/) override {
    for (const StackText& text : stack_texts(stack())) {
      add_text(text.name, text.text);
    }
    if (stack().format != OutputFormat::kSl1) return;
    // The sizes that Prusa's printers and PrusaSlicer's window have.
    for (const auto& [width, height] : {std::pair(400U, 400U), {800U, 480U}}) {
      add_text(fmt::format("thumbnail/thumbnail{}x{}.png", width, height),
               encode_rgb_png(width, height, draw_preview(width, height)));
    }
  }

 protected:
  std::string next_name() const {
    return image_name(stack(), stack().layers.size());
  }
  virtual void add_text(const std::string& name, std::string_view bytes) = 0;
};

class FolderWriter : public NamedStackWriter {
 public:
  FolderWriter(const WriterOptions& options, const std::string& path,
               TemporaryFiles& files)
      : NamedStackWriter(options, path),
        folder_(OutputFolder::open(path, kFolderContents, files)) {}

  void commit() override { folder_.commit(); }
  std::uint64_t size() const override { return folder_.size(); }

 private:
  void add_image(std::string_view bytes) override {
    folder_.add(next_name(), bytes);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    folder_.add(name, bytes);
  }

  OutputFolder folder_;
};

class ArchiveWriter : public NamedStackWriter {
 public:
  ArchiveWriter(const WriterOptions& options, const std::string& path,
                TemporaryFiles& files)
      : NamedStackWriter(options, path),
        file_(OutputFile::open(path, files)),
        archive_(file_) {}

  // Printers and slicers of Prusa pack images, too.
  std::string encode(const Layer& layer) const override {
    return ZipOutput::pack(ImageStackWriter::encode(layer));
  }
  void finish(Diagnostics& diagnostics) override {
    NamedStackWriter::finish(diagnostics);
    archive_.finish();
  }
  void commit() override { file_.commit(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  void add_image(std::string_view packed) override {
    archive_.add_packed(next_name(), packed);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    archive_.add_text(name, bytes);
  }

  OutputFile file_;
  ZipOutput archive_;
};

}  // namespace

ImageStackWriter::ImageStackWriter(const WriterOptions& options,
                                   const std::string& path) {
  stack_.format = options.format;
  stack_.job = job_name(path);
  stack_.printer = options.printer;
  stack_.exposure = options.exposure;
  stack_.material = options.material;
  map_ = map_around(Vec2(0));
}

void ImageStackWriter::begin(const Box3& box) {
  map_ = map_around((Vec2(box.low) + Vec2(box.high)) / 2.0);
  const bool has_preview = stack_.format == OutputFormat::kSl1 ||
                           stack_.format == OutputFormat::kGoo ||
                           stack_.format == OutputFormat::kCtb;
  if (has_preview) preview_ = Preview(box);
}

std::string ImageStackWriter::encode(const Layer& layer) const {
  const Printer& printer = stack_.printer;
  return draw_grey_png(layer.contours, printer.width, printer.height, map_,
                       stack_.format == OutputFormat::kNanoDlp
                           ? printer.nanodlp_layout
                           : PixelLayout::kGrey);
}

void ImageStackWriter::take_encoded(const Layer& layer,
                                    const std::string& encoded) {
  ImageLayer measures = measure(layer);
  note_thickness(measures.thickness);
  add_image(encoded.empty() ? encode(layer) : encoded);
  preview_.take(layer);
  stack_.volume +=
      std::accumulate(measures.regions.begin(), measures.regions.end(), 0.0) *
      (layer.top - layer.bottom);
  stack_.layers.push_back(std::move(measures));
}

// Maps the design to pixels so that `middle` [mm] is in the panel's middle.
PixelMap ImageStackWriter::map_around(Vec2 middle) const {
  const Printer& printer = stack_.printer;
  PixelMap map;
  map.per_x = {printer.right.x / printer.pixel.x,
               -printer.up.x / printer.pixel.y};
  map.per_y = {printer.right.y / printer.pixel.x,
               -printer.up.y / printer.pixel.y};
  map.origin = Vec2(printer.width, printer.height) / 2.0 - map(middle);
  return map;
}

// Throws GeometryError where the layer reaches beyond the panel.
ImageLayer ImageStackWriter::measure(const Layer& layer) const {
  const Printer& printer = stack_.printer;
  const Vec2 size(printer.width, printer.height);
  ImageLayer measures;
  measures.z = layer.section_z;
  measures.thickness = thickness_of(layer);
  measures.regions = areas_of_regions(layer.contours);
  if (layer.contours.points.empty()) return measures;
  measures.low = measures.high = map_(layer.contours.points.front());
  for (const Vec2& point : layer.contours.points) {
    measures.low = glm::min(measures.low, map_(point));
    measures.high = glm::max(measures.high, map_(point));
  }
  const bool fits =
      glm::all(glm::greaterThanEqual(measures.low, Vec2(-kSlack))) &&
      glm::all(glm::lessThanEqual(measures.high, size + kSlack));
  if (fits) {
    measures.low = glm::max(measures.low, Vec2(0));
    measures.high = glm::min(measures.high, size);
    return measures;
  }
  const Vec2 mm = (measures.high - measures.low) * printer.pixel;
  throw TooLarge(printer, printer.right.x != 0
                              ? Vec3(mm, measures.thickness)
                              : Vec3(mm.y, mm.x, measures.thickness));
}

void ImageStackWriter::note_thickness(double thickness) {
  if (stack_.layers.empty()) stack_.layer_thickness = thickness;
  if (stack_.layer_thickness == thickness) return;
  if (needs_one_thickness(stack_.format)) {
    throw GeometryError(
        ".sl1, .zip, .goo and .ctb need layers of one thickness");
  }
  stack_.layer_thickness = 0;
}

std::unique_ptr<LayerWriter> make_image_stack_writer(
    const WriterOptions& options, const std::string& path,
    TemporaryFiles& temporary_files) {
  if (options.format == OutputFormat::kPng) {
    return std::make_unique<FolderWriter>(options, path, temporary_files);
  }
  return std::make_unique<ArchiveWriter>(options, path, temporary_files);
}

}  // namespace lamina::slicer
