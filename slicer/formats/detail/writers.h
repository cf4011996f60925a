#pragma once
// The writers behind make_layer_writer(): one function for each format, in a
// source file of its name. Each takes of the options what its format knows.

#include <cstdint>
#include <memory>
#include <string>

#include "base/file/output_file.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::slicer {

// A writer whose output is one file.
class FileWriter : public LayerWriter {
 public:
  void commit() final { output_.commit(); }
  std::uint64_t size() const final { return output_.size(); }

 protected:
  FileWriter(const std::string& path, TemporaryFiles& temporary_files)
      : output_(OutputFile::open(path, temporary_files)) {}

  OutputFile output_;
};

// A function that opens an output; throws FileError where it cannot be made.
using MakeLayerWriter = std::unique_ptr<LayerWriter>(
    const WriterOptions& options, const std::string& path,
    TemporaryFiles& temporary_files);

MakeLayerWriter make_cli_writer;
MakeLayerWriter make_ctb_writer;
MakeLayerWriter make_goo_writer;
MakeLayerWriter make_image_stack_writer;
MakeLayerWriter make_layers_json_writer;
MakeLayerWriter make_slc_writer;
MakeLayerWriter make_svg_writer;
MakeLayerWriter make_threemf_writer;

}  // namespace lamina::slicer
