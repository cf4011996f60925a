#pragma once
// Which faces the rays of a picture meet, as the GL sampler asks OpenGL.
//
// Zeng et al. 2011 (section 3) read depths and normals back from the graphics
// processor. Departure: here a fragment says which face it is of, and the
// sampler computes where. A depth of 32 bits is rounded to 6e-6 mm in a leaf of
// 100 mm, so that faces of two leaves which coincide would no longer tie
// (kTieDistance), and leave skins; and what is read back is a third.
//
// All fragments of a pixel are found by depth peeling, as in the paper: pass k
// keeps the nearest fragment behind the one of pass k-1, until nothing is left.
// The order is by depth and then by face, since of faces that coincide all but
// one would be lost otherwise. Depths are floats of 32 bits: a buffer of 24
// rounds them, so that a fragment lies behind itself and peeling never ends.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ldni/gl/gl_context.h"

namespace lamina::ldni {

// The precision that a context must have. Corners on whole steps of 1/256 pixel
// in a viewport of this size are exact in 32 bits all the way to the
// rasteriser. A larger one would not do: llvmpipe loses triangles that reach
// 4000 pixels beyond a small picture (Mesa 22.3.6).
inline constexpr int kSubPixelBits = 8;
inline constexpr int kViewportSize = 1 << 12;

// Pictures are at most this large, either way; corners may lie outside of one
// by kPictureMargin either way.
inline constexpr int kPictureSize = 1 << 11;
inline constexpr int kPictureMargin = (kViewportSize - kPictureSize) / 2;

// Triangles of a picture, at most: 36 bytes each.
inline constexpr std::size_t kPictureTriangles = 3'000'000;

// A corner as OpenGL gets it, in pixels from the lower left corner of the
// picture; pixel i reaches from i to i + 1. depth: from 0 to 1 along the rays.
struct RasterCorner {
  float x;
  float y;
  float depth;
};

// A fragment: a face over the centre of a pixel.
struct Fragment {
  std::uint32_t pixel;  // row · width + column
  std::uint32_t face_and_side;

  std::uint32_t face() const { return face_and_side >> 1; }
  bool is_entry() const { return (face_and_side & 1) != 0; }
};

// One object per thread.
class FaceRaster {
 public:
  virtual ~FaceRaster() = default;

  // Appends the fragments of all triangles in a picture of width × height
  // pixels, in any order. Entries are faces whose corners run
  // counter-clockwise.
  //
  // corners  three for each triangle
  // returns  false if there are too many fragments (16 million); `fragments` is
  //          then as it was
  virtual bool draw(std::span<const RasterCorner> corners, int width,
                    int height, std::vector<Fragment>& fragments) = 0;
};

std::unique_ptr<FaceRaster> make_face_raster(const GlPlatform& platform);

}  // namespace lamina::ldni
