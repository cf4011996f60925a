#pragma once
// Writes layers as images for the panels of resin printers: a folder of PNG
// files, or Prusa's SL1 archive (docs/formats.md).
//
// The grey of a pixel is the share of it that the layer covers, by area. The
// middle of the design's box stands in the middle of the panel.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "slicer/formats/layer_writer.h"
#include "slicer/panel.h"

namespace lamina::slicer {

// Where the images and texts of a stack go, by name.
class StackOutput {
 public:
  virtual ~StackOutput() = default;
  virtual void add_image(const std::string& name, std::string_view bytes) = 0;
  virtual void add_text(const std::string& name, std::string_view bytes) = 0;
  virtual void finish() = 0;
  virtual void commit() = 0;
  virtual std::uint64_t size() const = 0;
};

// What is known when the last layer is written.
struct StackSummary {
  std::string job;  // name of the design's output, without folder and ending
  Panel panel;
  std::uint32_t layers = 0;
  // Of the last layer, which is that of all but in folders [mm].
  double layer_thickness = 0;
  double volume = 0;                // of the layers [mm³]
  std::vector<double> heights;      // of the sections [mm]
  std::vector<double> thicknesses;  // of the layers [mm]
};

class ImageStackWriter : public LayerWriter {
 public:
  // format  kPng or kSl1
  // Throws FileError if the output cannot be made.
  ImageStackWriter(OutputFormat format, const Panel& panel,
                   const std::string& path, TemporaryFiles& temporary_files);
  ~ImageStackWriter() override;

  void begin(const Box3& box) override;
  // The layer's image.
  std::string encode(const Layer& layer) const override;
  // Throws GeometryError where the layer reaches beyond the panel.
  void take(const Layer& layer) override;
  void finish(Diagnostics& diagnostics) override;
  void commit() override { output_->commit(); }
  std::uint64_t size() const override { return output_->size(); }

 private:
  void check_reach(const Layer& layer) const;

  const OutputFormat format_;
  std::unique_ptr<StackOutput> output_;
  StackSummary summary_;
  PixelMap map_;
};

}  // namespace lamina::slicer
