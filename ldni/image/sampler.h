#pragma once
// The contract of all samplers: each makes the layered depth-normal image
// (LDNI) of a leaf.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "csg/scene.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sample.h"

namespace lamina::ldni {

// A leaf instance, and the rays and layers where it is sampled (not empty).
struct LeafBox {
  std::uint32_t instance = 0;  // into csg::Scene::instances
  GridBox box;
};

// The samples of one leaf instance: the adaptive LDNI of the paper where the
// box is the leaf's own.
struct LeafImage : LeafBox {
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

// How the samples are made: exactly, or drawn by OpenGL.
enum class SamplerKind : std::uint8_t { kScanline, kGl };

// Their names, in this order, in options and reports.
inline constexpr std::array<std::string_view, 2> kSamplerNames = {"scanline",
                                                                  "gl"};

// One object per thread: it owns scratch, or a graphics context.
class Sampler {
 public:
  virtual ~Sampler() = default;

  // Appends the image of a leaf. Every pixel gets as many entries as exits, in
  // no particular order; a vertex on a section counts as below it
  // (LayerGrid::layers_below).
  virtual void sample(const LeafBox& leaf, LeafImages& out) = 0;

  // Pixels so far that had to be sampled another way to keep this contract.
  virtual std::uint64_t repaired_pixels() const { return 0; }
};

// The exact sampler, the reference for all others. All arguments must outlive
// it.
//
// Cost of an image: the rings of lofts, the vertices of rings that meet the
// box, the vertices and triangles of meshes, the samples, the pixels of the
// box.
std::unique_ptr<Sampler> make_scanline_sampler(const csg::Scene& scene,
                                               const RayGrid& rays,
                                               const LayerGrid& layers);

// The sampler of Zeng et al. 2011, by OpenGL. Scene and grids must outlive it;
// layers must be of equal thickness.
//
// Cost of an image: the leaf's vertices and triangles, made for it if it is a
// loft; a drawing and a picture for each peel; the samples. Memory: at most 128
// MiB for what is drawn at a time.
std::unique_ptr<Sampler> make_gl_sampler(const csg::Scene& scene,
                                         const RayGrid& rays,
                                         const LayerGrid& layers,
                                         std::unique_ptr<FaceRaster> raster);

}  // namespace lamina::ldni
