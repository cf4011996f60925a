#include "bench/section_rival/slc_file.h"

namespace lamina::rival {

void SlcFile::begin(double bottom, double top) {
  has_begun_ = true;
  output_.write(
      "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE section rival\r\n\x1A");
  output_.write(std::string(256, '\0'));
  append(std::uint8_t{1});
  append(static_cast<float>(bottom));
  append(static_cast<float>(top - bottom));
  append(0.0F);
  append(0.0F);
}

void SlcFile::add_layer(double bottom, double top,
                        const std::vector<const ClipperLib::Path*>& paths) {
  if (!has_begun_) begin(bottom, top);
  top_ = static_cast<float>(top);
  append(static_cast<float>(bottom));
  append(static_cast<std::uint32_t>(paths.size()));
  for (const ClipperLib::Path* path : paths) add_path(*path);
}

void SlcFile::add_path(const ClipperLib::Path& path) {
  numbers_.clear();
  for (const ClipperLib::IntPoint& point : path) {
    numbers_.push_back(
        static_cast<float>(static_cast<double>(point.X) * mm_per_unit_));
    numbers_.push_back(
        static_cast<float>(static_cast<double>(point.Y) * mm_per_unit_));
  }
  numbers_.push_back(numbers_[0]);
  numbers_.push_back(numbers_[1]);
  append(static_cast<std::uint32_t>(path.size() + 1));
  append(std::uint32_t{0});
  output_.write({reinterpret_cast<const char*>(numbers_.data()),
                 numbers_.size() * sizeof(float)});
}

void SlcFile::finish() {
  append(top_);
  append(std::uint32_t{0xFFFFFFFF});
}

}  // namespace lamina::rival
