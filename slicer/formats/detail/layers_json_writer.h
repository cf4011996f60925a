#pragma once
// Writes `.layers.json`: the layers for programs and tests, with every digit.
//
//   {"units":"mm","layers":[
//   {"z":…,"bottom":…,"top":…,"contours":[{"hole":false,"points":[[x,y],…]}]}
//   ]}
//
// z is the height of the section. One line a layer; numbers are the shortest
// that read back as the same double.

#include <string>

#include "slicer/formats/layer_writer.h"

namespace lamina::slicer {

class LayersJsonWriter : public FileWriter {
 public:
  LayersJsonWriter(const std::string& path, TemporaryFiles& temporary_files);

  void take(const Layer& layer) override;
  void finish(Diagnostics& diagnostics) override;

 private:
  bool has_layers_ = false;
};

}  // namespace lamina::slicer
