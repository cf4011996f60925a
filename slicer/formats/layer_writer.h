#pragma once
// What all writers of layer files have in common.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "slicer/contour/layer.h"
#include "slicer/formats/output_format.h"
#include "slicer/formats/panel.h"

namespace lamina::slicer {

class LayerWriter : public LayerSink {
 public:
  // To be called once, after the last layer. Warns of what the format cannot
  // tell.
  virtual void finish(Diagnostics& diagnostics) = 0;

  // Makes the output visible under its name; to be called after finish().
  virtual void commit() = 0;

  // Bytes so far.
  virtual std::uint64_t size() const = 0;

  // Layers in which points had to move by more than rounding to the format's
  // numbers, so that no two loops fell together.
  virtual std::uint64_t snapped_layers() const { return 0; }

  // What the format's numbers moved a point by, at most, so far [mm].
  virtual double greatest_rounding() const { return 0; }
};

// A writer of one file.
class FileWriter : public LayerWriter {
 public:
  void commit() final { output_.commit(); }
  std::uint64_t size() const final { return output_.size(); }

 protected:
  // Throws FileError if the file cannot be made.
  FileWriter(const std::string& path, TemporaryFiles& temporary_files)
      : output_(path, temporary_files) {}

  OutputFile output_;
};

struct WriterOptions {
  OutputFormat format = OutputFormat::kSlc;  // one of layers
  CliEncoding cli = CliEncoding::kBinary;
  Panel panel;  // of formats of images
  // Bound on what the contours that the writer takes deviate by [mm], if there
  // is one; noted where the format has a place for it.
  std::optional<double> deviation;
};

// path  "-": standard output
// Throws FileError if the output cannot be made.
std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               const std::string& path,
                                               TemporaryFiles& temporary_files);

}  // namespace lamina::slicer
