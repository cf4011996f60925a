#pragma once
// Reads SLC 2.0 files (docs/formats.md), layer by layer.
//
// Nothing in a file is trusted: every count is checked against the bytes that
// really follow before memory is asked for, and whatever breaks the format's
// frame throws FileError with the byte offset. What merely breaks a rule (an
// open loop, a repeat) is handed over, so that `lamina inspect` can report it.

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_file.h"

namespace lamina::slicer {

// Bytes behind the header's text.
inline constexpr std::size_t kSlcReservedSize = 256;
// Stands for the count of boundaries behind the last layer.
inline constexpr std::uint32_t kSlcEndOfLayers = 0xFFFFFFFF;

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

  // What the file says; the top of the part is known when read_layer() has
  // returned false.
  const LayerFileFacts& facts() const { return facts_; }

  // Replaces `layer` by the next one; false at the end of the layers. Throws
  // FileError.
  bool read_layer(SlcLayer& layer);

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void read(char* bytes, std::size_t count, std::string_view what);
  template <typename Value>
  Value read_value(std::string_view what);
  void require_finite(float value) const;
  void read_header();
  std::string read_header_text();
  void read_sampling();
  void require_end();
  void read_points(std::uint32_t count, std::vector<Vec2>& points);
  [[noreturn]] void fail(std::string_view message) const;

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t offset_ = 0;
  LayerFileFacts facts_;
  double mm_per_unit_ = 1;
};

// Returns the layer as the rest of lamina has it: loops without the closing
// vertex.
Layer to_layer(const SlcLayer& layer);

}  // namespace lamina::slicer
