// Writes layers as images for the panels of resin printers: a folder of PNG
// files, Prusa's SL1 archive, or NanoDLP's (docs/formats.md).
//
// The grey of a pixel is the share of it that the layer covers, by area. The
// middle of the design's box stands in the middle of the panel.

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
#include "slicer/contour/layer_measures.h"
#include "slicer/formats/detail/grey_png.h"
#include "slicer/formats/detail/image_stack.h"
#include "slicer/formats/detail/writers.h"

namespace lamina::slicer {
namespace {

// A part as large as the panel fits, whatever rounding its numbers saw.
constexpr double kSlack = 1e-3;  // [pixels]

// The name of the print job, which printers show: "ring" of "out/ring.sl1".
std::string job_name(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  name.resize(std::min(name.size(), name.rfind('.')));
  return name.empty() || name == "-" ? "lamina" : name;
}

// The layer's thickness without the rounding of its heights.
double thickness_of(const Layer& layer) {
  constexpr double kPerMm = 1e9;
  return std::round((layer.top - layer.bottom) * kPerMm) / kPerMm;
}

class ImageStackWriter : public LayerWriter {
 public:
  ImageStackWriter(const WriterOptions& options, const std::string& path) {
    stack_.format = options.format;
    stack_.job = job_name(path);
    stack_.panel = options.panel;
    map_ = options.panel.map_around(Vec2(0));
  }

  void begin(const Box3& box) override {
    map_ = stack_.panel.map_around((Vec2(box.low) + Vec2(box.high)) / 2.0);
  }

  // Returns the layer's image.
  std::string encode(const Layer& layer) const override {
    const Panel& panel = stack_.panel;
    return draw_grey_png(layer.contours, panel.width, panel.height, map_,
                         stack_.format == OutputFormat::kNanoDlp
                             ? panel.nanodlp_layout
                             : PixelLayout::kGrey);
  }

  // Throws GeometryError where the layer reaches beyond the panel, or where the
  // format wants one thickness and the layer has another than the first one.
  void take(const Layer& layer) override {
    ImageLayer measures = measure(layer);
    const std::string name = image_name(stack_, stack_.layers.size());
    add_image(name, layer.encoded.empty() ? encode(layer) : layer.encoded);
    note_thickness(measures.thickness);
    stack_.volume +=
        std::accumulate(measures.regions.begin(), measures.regions.end(), 0.0) *
        (layer.top - layer.bottom);
    stack_.layers.push_back(std::move(measures));
  }

  void finish(Diagnostics& /*diagnostics*/) override {
    for (const StackText& text : stack_texts(stack_)) {
      add_text(text.name, text.text);
    }
  }

 protected:
  virtual void add_image(const std::string& name, std::string_view bytes) = 0;
  virtual void add_text(const std::string& name, std::string_view bytes) = 0;

 private:
  // Throws GeometryError where the layer reaches beyond the panel.
  ImageLayer measure(const Layer& layer) const {
    const Panel& panel = stack_.panel;
    const Vec2 size(panel.width, panel.height);
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
    throw GeometryError(fmt::format(
        "The design is larger than the panel of {:.6g} mm x {:.6g} mm "
        "({}): the layer at {:.6g} mm reaches beyond it",
        panel.width * panel.pixel.x, panel.height * panel.pixel.y, panel.name,
        layer.section_z));
  }

  void note_thickness(double thickness) {
    if (stack_.layers.empty()) stack_.layer_thickness = thickness;
    if (stack_.layer_thickness == thickness) return;
    if (stack_.format != OutputFormat::kPng) {
      throw GeometryError(".sl1 and .zip need layers of one thickness");
    }
    stack_.layer_thickness = 0;
  }

  ImageStack stack_;
  PixelMap map_;
};

class FolderWriter : public ImageStackWriter {
 public:
  FolderWriter(const WriterOptions& options, const std::string& path,
               TemporaryFiles& files)
      : ImageStackWriter(options, path),
        folder_(OutputFolder::open(path, kFolderContents, files)) {}

  void commit() override { folder_.commit(); }
  std::uint64_t size() const override { return folder_.size(); }

 private:
  void add_image(const std::string& name, std::string_view bytes) override {
    folder_.add(name, bytes);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    folder_.add(name, bytes);
  }

  OutputFolder folder_;
};

class ArchiveWriter : public ImageStackWriter {
 public:
  ArchiveWriter(const WriterOptions& options, const std::string& path,
                TemporaryFiles& files)
      : ImageStackWriter(options, path),
        file_(OutputFile::open(path, files)),
        archive_(file_) {}

  void finish(Diagnostics& diagnostics) override {
    ImageStackWriter::finish(diagnostics);
    archive_.finish();
  }
  void commit() override { file_.commit(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  void add_image(const std::string& name, std::string_view bytes) override {
    archive_.add_packed(name, bytes);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    archive_.add_text(name, bytes);
  }

  OutputFile file_;
  ZipOutput archive_;
};

}  // namespace

std::unique_ptr<LayerWriter> make_image_stack_writer(
    const WriterOptions& options, const std::string& path,
    TemporaryFiles& temporary_files) {
  if (options.format == OutputFormat::kPng) {
    return std::make_unique<FolderWriter>(options, path, temporary_files);
  }
  return std::make_unique<ArchiveWriter>(options, path, temporary_files);
}

}  // namespace lamina::slicer
