#pragma once
// A writer of layers whose output is one file.

#include <cstdint>
#include <string>

#include "base/file/output_file.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::slicer {

class FileWriter : public LayerWriter {
 public:
  void commit() final { output_.commit(); }
  std::uint64_t size() const final { return output_.size(); }

 protected:
  FileWriter(const std::string& path, TemporaryFiles& temporary_files)
      : output_(OutputFile::open(path, temporary_files)) {}

  OutputFile output_;
};

}  // namespace lamina::slicer
