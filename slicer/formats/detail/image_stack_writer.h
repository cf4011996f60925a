#pragma once
// Writes layers as images for the panels of resin printers: a folder of PNG
// files, Prusa's SL1 archive, or NanoDLP's (docs/formats.md).
//
// The grey of a pixel is the share of it that the layer covers, by area. The
// middle of the design's box stands in the middle of the panel.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "slicer/formats/detail/image_stack.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/formats/panel.h"

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

class ImageStackWriter : public LayerWriter {
 public:
  // format  one of images
  // Throws FileError if the output cannot be made.
  ImageStackWriter(OutputFormat format, const Panel& panel,
                   const std::string& path, TemporaryFiles& temporary_files);
  ~ImageStackWriter() override;

  void begin(const Box3& box) override;
  // The layer's image.
  std::string encode(const Layer& layer) const override;
  // Throws GeometryError where the layer reaches beyond the panel, or is of
  // another thickness than the first one and the format cannot tell that.
  void take(const Layer& layer) override;
  void finish(Diagnostics& diagnostics) override;
  void commit() override { output_->commit(); }
  std::uint64_t size() const override { return output_->size(); }

 private:
  ImageLayer measure(const Layer& layer) const;
  void note_thickness(double thickness);

  std::unique_ptr<StackOutput> output_;
  ImageStack stack_;
  PixelMap map_;
};

}  // namespace lamina::slicer
