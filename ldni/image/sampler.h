#pragma once
// The contract of all samplers: each makes the layered depth-normal image
// (LDNI) of a leaf.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ldni/image/ray_grid.h"
#include "ldni/image/sample.h"

namespace lamina::ldni {

// The samples of one leaf instance in a box of rays and layers: the adaptive
// LDNI of the paper where the box is the leaf's own.
struct LeafImage {
  std::uint32_t instance = 0;  // into csg::Scene::instances
  GridBox box;
  std::size_t first_pixel = 0;  // into LeafImages::ends
};

// The images of many leaves, pixel by pixel in flat arrays. Pixels of an image
// are its layers' rows of rays, one after another.
struct LeafImages {
  std::vector<LeafImage> images;
  std::vector<std::uint32_t> ends;  // pixel p: samples [ends[p-1], ends[p])
  std::vector<Sample> samples;

  // Returns the samples of one ray, by the image's own (local) indices.
  std::span<const Sample> ray(const LeafImage& image, std::uint32_t layer,
                              std::uint32_t index) const {
    const std::size_t pixel =
        image.first_pixel + std::size_t{layer} * image.box.ray_count + index;
    const std::size_t begin = pixel == 0 ? 0 : ends[pixel - 1];
    return {samples.data() + begin, ends[pixel] - begin};
  }
  void clear() {
    images.clear();
    ends.clear();
    samples.clear();
  }
};

// How the samples are made: exactly, or drawn by OpenGL, by a list of fragments
// or by the paper's depth peeling.
enum class SamplerKind { kScanline, kGl, kGlPeeling };

// One object per thread: it owns scratch, or a graphics context.
class Sampler {
 public:
  virtual ~Sampler() = default;

  // Appends the image of `instance` in the rays and layers of `box` (not
  // empty). Every pixel gets as many entries as exits, in no particular order;
  // a vertex on a section counts as below it (LayerGrid::layers_below).
  virtual void sample(std::uint32_t instance, const GridBox& box,
                      LeafImages& out) = 0;

  // Pixels so far that had to be sampled another way to keep this contract.
  virtual std::uint64_t repaired_pixels() const { return 0; }
};

}  // namespace lamina::ldni
