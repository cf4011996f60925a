#pragma once
// What the writers of images for panels have in common: where on the panel the
// design is, what is measured of each layer, and the preview.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slicer/formats/detail/image_stack.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/pixels/coverage.h"
#include "slicer/pixels/preview.h"

namespace lamina::slicer {

class ImageStackWriter : public LayerWriter {
 public:
  ImageStackWriter(const WriterOptions& options, const std::string& path);

  void begin(const Box3& box) override;

  // Returns the layer's image, a PNG file where the format has no other.
  std::string encode(const Layer& layer) const override;

  // Throws GeometryError where the layer reaches beyond the panel, or where the
  // format wants one thickness and the layer has another than the first one.
  void take_encoded(const Layer& layer, const std::string& encoded) override;

  void take(const Layer& layer) override { take_encoded(layer, {}); }

 protected:
  // bytes  of encode(), of the layer behind those that stack() has
  virtual void add_image(std::string_view bytes) = 0;

  const ImageStack& stack() const { return stack_; }
  const PixelMap& map() const { return map_; }

  // Rows from the top, of red, green and blue.
  std::vector<std::uint8_t> draw_preview(unsigned width,
                                         unsigned height) const {
    return preview_.draw(width, height);
  }

 private:
  PixelMap map_around(Vec2 middle) const;
  ImageLayer measure(const Layer& layer) const;
  void note_thickness(double thickness);

  ImageStack stack_;
  PixelMap map_;
  Preview preview_;
};

}  // namespace lamina::slicer
