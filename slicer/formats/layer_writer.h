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

struct WriterOptions {
  OutputFormat format = OutputFormat::kSlc;  // one of layers
  CliEncoding cli = CliEncoding::kBinary;
  // Bound on what the contours that the writer takes deviate by [mm], if there
  // is one; noted where the format has a place for it.
  std::optional<double> deviation;
};

// `output` must outlive the writer.
std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               OutputFile& output);

}  // namespace lamina::slicer
