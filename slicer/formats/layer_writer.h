#pragma once
// What all writers of layer files have in common.

#include <cstdint>
#include <memory>
#include <optional>

#include "parser/diagnostic.h"
#include "slicer/formats/output_file.h"
#include "slicer/formats/output_format.h"
#include "slicer/layer.h"

namespace lamina::slicer {

class LayerWriter : public LayerSink {
 public:
  // To be called once, after the last layer; the caller then commits the
  // output. Warns of what the format cannot tell.
  virtual void finish(Diagnostics& diagnostics) = 0;

  // Layers in which points had to move by more than rounding to the format's
  // numbers, so that no two loops fell together.
  virtual std::uint64_t snapped_layers() const { return 0; }

  // What the format's numbers moved a point by, at most, so far [mm].
  virtual double greatest_rounding() const { return 0; }
};

// A writer of `format`, which must be a format of layers. `output` must
// outlive it.
//
// deviation  bound on what the contours that it takes deviate by [mm], if there
//            is one; noted where the format has a place for it
std::unique_ptr<LayerWriter> make_layer_writer(OutputFormat format,
                                               OutputFile& output,
                                               std::optional<double> deviation);

}  // namespace lamina::slicer
