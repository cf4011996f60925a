#include "slicer/formats/image_stack_writer.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "parser/diagnostic.h"
#include "slicer/formats/output_folder.h"
#include "slicer/formats/zip_output.h"
#include "slicer/grey_png.h"
#include "slicer/version.h"

namespace lamina::slicer {
namespace {

constexpr const char* kContents = "index.json";

// A part as large as the panel fits, whatever rounding its numbers saw.
constexpr double kSlack = 1e-3;  // [pixels]

class FolderStack : public StackOutput {
 public:
  FolderStack(const std::string& path, TemporaryFiles& files)
      : folder_(path, kContents, files) {}

  void add_image(const std::string& name, std::string_view bytes) override {
    folder_.add(name, bytes);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    folder_.add(name, bytes);
  }
  void finish() override {}
  void commit() override { folder_.commit(); }
  std::uint64_t size() const override { return folder_.size(); }

 private:
  OutputFolder folder_;
};

class ArchiveStack : public StackOutput {
 public:
  ArchiveStack(const std::string& path, TemporaryFiles& files)
      : file_(path, files), archive_(file_) {}

  void add_image(const std::string& name, std::string_view bytes) override {
    archive_.add_packed(name, bytes);
  }
  void add_text(const std::string& name, std::string_view bytes) override {
    archive_.add_text(name, bytes);
  }
  void finish() override { archive_.finish(); }
  void commit() override { file_.commit(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  OutputFile file_;
  ZipOutput archive_;
};

// "out/ring.sl1": "ring". Printers show it.
std::string job_name(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  name = name.substr(0, name.rfind('.'));
  return name.empty() || name == "-" ? "lamina" : name;
}

std::string image_name(OutputFormat format, const StackSummary& summary,
                       std::uint32_t layer) {
  return fmt::format("{}{:05}.png",
                     format == OutputFormat::kSl1 ? summary.job : "", layer);
}

// What Prusa's printers and UVtools read; times are set on the printer.
std::string sl1_config(const StackSummary& summary) {
  constexpr double kExposure = 8;  // [s]
  constexpr double kFirstExposure = 35;
  return fmt::format(
      "action = print\n"
      "expTime = {}\n"
      "expTimeFirst = {}\n"
      "jobDir = {}\n"
      "layerHeight = {:.6g}\n"
      "numFade = 10\n"
      "numFast = {}\n"
      "numSlow = 0\n"
      "printerModel = {}\n"
      "printerVariant = default\n"
      "prusaSlicerVersion = lamina-{}\n"
      "usedMaterial = {:.6f}\n",
      kExposure, kFirstExposure, summary.job, summary.layer_thickness,
      summary.layers, summary.panel.name == "prusa-sl1s" ? "SL1S" : "SL1",
      version(), summary.volume / 1000);
}

std::string index_of(const StackSummary& summary) {
  nlohmann::ordered_json index;
  index["software"] = fmt::format("lamina {}", version());
  index["units"] = "mm";
  index["pixels"] = {summary.panel.width, summary.panel.height};
  index["pixel_mm"] = {summary.panel.pixel.x, summary.panel.pixel.y};
  const auto& all = summary.thicknesses;
  const bool is_uniform = std::adjacent_find(all.begin(), all.end(),
                                             std::not_equal_to()) == all.end();
  index["layer_thickness"] = is_uniform ? summary.layer_thickness : 0;
  index["volume_mm3"] = summary.volume;
  auto& layers = index["layers"] = nlohmann::ordered_json::array();
  for (std::uint32_t i = 0; i < summary.layers; ++i) {
    layers.push_back({{"file", image_name(OutputFormat::kPng, summary, i)},
                      {"z", summary.heights[i]},
                      {"thickness", summary.thicknesses[i]}});
  }
  return index.dump(1) + "\n";
}

std::unique_ptr<StackOutput> open_stack(OutputFormat format,
                                        const std::string& path,
                                        TemporaryFiles& files) {
  if (format == OutputFormat::kPng) {
    return std::make_unique<FolderStack>(path, files);
  }
  return std::make_unique<ArchiveStack>(path, files);
}

// Without what subtracting heights left of rounding.
double thickness_of(const Layer& layer) {
  constexpr double kPerMm = 1e9;
  return std::round((layer.top - layer.bottom) * kPerMm) / kPerMm;
}

double area_of(const ldni::Contours& contours) {
  double area = 0;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    area += ldni::signed_area(contours.loop(i));
  }
  return area;
}

}  // namespace

ImageStackWriter::ImageStackWriter(OutputFormat format, const Panel& panel,
                                   const std::string& path,
                                   TemporaryFiles& temporary_files)
    : format_(format), output_(open_stack(format, path, temporary_files)) {
  summary_.job = job_name(path);
  summary_.panel = panel;
  map_ = panel.map_around(Vec2(0));
}

ImageStackWriter::~ImageStackWriter() = default;

void ImageStackWriter::begin(const Box3& box) {
  map_ = summary_.panel.map_around((Vec2(box.low) + Vec2(box.high)) / 2.0);
}

void ImageStackWriter::check_reach(const Layer& layer) const {
  const Panel& panel = summary_.panel;
  for (const Vec2& point : layer.contours.points) {
    const Vec2 place = map_(point);
    if (place.x >= -kSlack && place.x <= panel.width + kSlack &&
        place.y >= -kSlack && place.y <= panel.height + kSlack) {
      continue;
    }
    throw GeometryError(
        {Severity::kError,
         {},
         fmt::format(
             "The design is larger than the panel of {:.6g} mm x {:.6g} mm "
             "({}): the layer at {:.6g} mm reaches beyond it",
             panel.width * panel.pixel.x, panel.height * panel.pixel.y,
             panel.name, layer.section_z)});
  }
}

std::string ImageStackWriter::encode(const Layer& layer) const {
  return draw_grey_png(layer.contours, summary_.panel.width,
                       summary_.panel.height, map_);
}

void ImageStackWriter::take(const Layer& layer) {
  check_reach(layer);
  const std::string name = image_name(format_, summary_, summary_.layers);
  if (layer.encoded.empty()) {
    output_->add_image(name, encode(layer));
  } else {
    output_->add_image(name, layer.encoded);
  }
  ++summary_.layers;
  summary_.layer_thickness = thickness_of(layer);
  summary_.volume += area_of(layer.contours) * (layer.top - layer.bottom);
  summary_.heights.push_back(layer.section_z);
  summary_.thicknesses.push_back(summary_.layer_thickness);
}

void ImageStackWriter::finish(Diagnostics& /*diagnostics*/) {
  if (format_ == OutputFormat::kSl1) {
    output_->add_text("config.ini", sl1_config(summary_));
  } else {
    output_->add_text(kContents, index_of(summary_));
  }
  output_->finish();
}

}  // namespace lamina::slicer
