#pragma once
// Layers into files, whatever their format (docs/formats.md).
//
// All who write layers use this one interface. detail/writers.h lists the
// formats.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/file/temporary_files.h"
#include "slicer/contour/layer.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/estimate.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// take() throws FileError or GeometryError for a layer that the format cannot
// hold.
class LayerWriter : public LayerSink {
 public:
  // To be called once, after the last layer. Warns of what the format cannot
  // express.
  virtual void finish(Diagnostics& diagnostics) = 0;

  // Makes the output visible under its name; to be called after finish().
  virtual void commit() = 0;

  // Bytes so far.
  virtual std::uint64_t size() const = 0;

  // Layers in which points had to move by more than rounding to the format's
  // numbers, so that no two loops fell together.
  virtual std::uint64_t snapped_layers() const { return 0; }

  // Greatest distance that the format's numbers moved a point by, so far [mm].
  virtual double greatest_rounding() const { return 0; }
};

struct WriterOptions {
  OutputFormat format = OutputFormat::kSlc;  // one of layers
  CliEncoding cli = CliEncoding::kBinary;
  // What formats of images need.
  Printer printer = {};
  Exposure exposure = {};
  std::string material = {};  // its title, one line; empty: none was named
  // Bound on the deviation of the contours that the writer takes [mm], if
  // known; noted where the format has a place for it.
  std::optional<double> deviation = {};
};

// path  "-": standard output
// Throws FileError if the output cannot be made.
std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               const std::string& path,
                                               TemporaryFiles& temporary_files);

}  // namespace lamina::slicer
