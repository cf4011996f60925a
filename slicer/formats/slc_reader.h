#pragma once
// Reads SLC 2.0 files (docs/formats.md), layer by layer.
//
// Files come from anywhere, so nothing in them is trusted: every count is
// checked against the bytes that really follow before memory is asked for, and
// whatever breaks the format's frame throws FileError with the byte offset.
// What merely breaks a rule (an open loop, a repeat) is handed over as it is,
// so that `lamina inspect` can report it.

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_file.h"

namespace lamina::slicer {

struct SlcHeader {
  std::string text;  // whole, without its end
  std::string version;
  std::string unit;  // "MM" or "INCH"
  std::string type;
  std::string package;
  // Bound on what contours deviate by, where lamina noted it [mm].
  std::optional<double> deviation;
  // x, y, z as {low, high} [file's unit], where the header has them.
  std::optional<std::array<Vec2, 3>> extents;
};

struct SlcLayer {
  double z = 0;          // lower side [mm]
  double thickness = 0;  // of the row in force [mm]
  std::vector<WrittenLoop> boundaries;
};

class SlcReader {
 public:
  // Reads up to the first layer. Throws FileError, also for the two other
  // formats with this suffix.
  explicit SlcReader(std::string path, const FileAccess& access = kAllFiles);

  const SlcHeader& header() const { return header_; }
  const std::vector<SamplingRow>& sampling() const { return sampling_; }
  // All that the file says; known when read_layer() has returned false.
  LayerFileFacts facts() const;

  // Replaces `layer` by the next one; false at the end of the layers. Throws
  // FileError.
  bool read_layer(SlcLayer& layer);

  // Top of the part [mm], from the end record; known when read_layer() has
  // returned false.
  double top() const { return top_; }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void read(char* bytes, std::size_t count, std::string_view what);
  template <typename Value>
  Value read_value(std::string_view what);
  void require_finite(float value) const;
  void read_header();
  void read_sampling();
  void read_points(std::uint32_t count, std::vector<Vec2>& points);
  [[noreturn]] void fail(std::string_view message) const;

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t offset_ = 0;
  SlcHeader header_;
  std::vector<SamplingRow> sampling_;
  double mm_per_unit_ = 1;
  double top_ = 0;
};

// Returns the layer as the rest of lamina has it: loops without the closing
// vertex.
Layer to_layer(const SlcLayer& layer);

}  // namespace lamina::slicer
