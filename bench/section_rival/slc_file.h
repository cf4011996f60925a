#pragma once
// Writes layers as SLC 2.0 the plain way: each number rounded by itself.

#include <cstdint>
#include <string>
#include <vector>

#include <polyclipping/clipper.hpp>

#include "base/file/output_file.h"

namespace lamina::rival {

class SlcFile {
 public:
  SlcFile(OutputFile& output, double units_per_mm)
      : output_(output), mm_per_unit_(1 / units_per_mm) {}

  // bottom, top  of the layer [mm]
  void add_layer(double bottom, double top,
                 const std::vector<const ClipperLib::Path*>& paths);
  void finish();

 private:
  template <typename Value>
  void append(Value value) {
    output_.write({reinterpret_cast<const char*>(&value), sizeof(value)});
  }
  void begin(double bottom, double top);
  void add_path(const ClipperLib::Path& path);

  OutputFile& output_;
  double mm_per_unit_;
  bool has_begun_ = false;
  float top_ = 0;
  std::vector<float> numbers_;
};

}  // namespace lamina::rival
