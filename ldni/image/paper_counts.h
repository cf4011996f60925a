#pragma once
// The counts and times of a job by the paper's method.

#include <cstdint>

#include "ldni/image/sample.h"

namespace lamina::ldni {

struct PaperCounts {
  // Size of the depth images, as if all were kept at once (table 3 of Zeng et
  // al. 2011).
  std::uint64_t pixels = 0;     // rays of all leaf images
  std::uint64_t samples = 0;    // of all leaves
  std::uint64_t intervals = 0;  // that the Boolean left

  std::uint64_t repaired_pixels = 0;  // Sampler::repaired_pixels()

  // Processor seconds, summed over threads.
  double boolean_seconds = 0;
  double link_seconds = 0;  // samples to loops

  // Of the leaves' images: where each pixel's samples end, and the samples.
  std::uint64_t image_bytes() const {
    return pixels * sizeof(std::uint32_t) + samples * sizeof(Sample);
  }

  PaperCounts& operator+=(const PaperCounts& other) {
    pixels += other.pixels;
    samples += other.samples;
    intervals += other.intervals;
    repaired_pixels += other.repaired_pixels;
    boolean_seconds += other.boolean_seconds;
    link_seconds += other.link_seconds;
    return *this;
  }
};

}  // namespace lamina::ldni
