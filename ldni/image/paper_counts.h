#pragma once
// The counts and times of a job by the paper's method.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ldni/image/sample.h"

namespace lamina::ldni {

// Size of a leaf's depth image, of all layers together.
struct LeafImageSize {
  std::uint64_t pixels = 0;
  std::uint32_t peels = 0;  // samples of its fullest pixel
};

struct PaperCounts {
  // Size of the depth images, as if all were kept at once (Table 3 of Zeng et
  // al. 2011).
  std::vector<LeafImageSize> leaves;  // by csg::Scene::instances, or empty
  std::uint64_t samples = 0;          // of all leaves
  std::uint64_t intervals = 0;        // that the Boolean left

  std::uint64_t repaired_pixels = 0;  // Sampler::repaired_pixels()

  // Processor seconds, summed over threads.
  double boolean_seconds = 0;
  double link_seconds = 0;  // samples to loops

  // Rays of all leaves' images.
  std::uint64_t pixels() const {
    std::uint64_t sum = 0;
    for (const LeafImageSize& leaf : leaves) sum += leaf.pixels;
    return sum;
  }

  // The images as lamina keeps them: where each pixel's samples end, and the
  // samples.
  std::uint64_t image_bytes() const {
    return pixels() * sizeof(std::uint32_t) + samples * sizeof(Sample);
  }

  // The images as the paper keeps them: for each peel of a leaf a depth (4
  // bytes) and a colour (3 bytes, the normal) in every pixel, hit or not.
  std::uint64_t dense_image_bytes() const {
    constexpr std::uint64_t kBytesPerPixel = 4 + 3;
    std::uint64_t sum = 0;
    for (const LeafImageSize& leaf : leaves) sum += leaf.pixels * leaf.peels;
    return sum * kBytesPerPixel;
  }

  PaperCounts& operator+=(const PaperCounts& other) {
    leaves.resize(std::max(leaves.size(), other.leaves.size()));
    for (std::size_t i = 0; i < other.leaves.size(); ++i) {
      leaves[i].pixels += other.leaves[i].pixels;
      leaves[i].peels = std::max(leaves[i].peels, other.leaves[i].peels);
    }
    samples += other.samples;
    intervals += other.intervals;
    repaired_pixels += other.repaired_pixels;
    boolean_seconds += other.boolean_seconds;
    link_seconds += other.link_seconds;
    return *this;
  }
};

}  // namespace lamina::ldni
