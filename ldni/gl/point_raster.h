#pragma once
// Which points of a set of triangles a camera sees.
//
// OpenGL draws with a depth buffer; a pixel gets no colour but the place that
// it shows, and the tag of its triangle. Light and shade are computed from
// these points elsewhere.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "ldni/gl/gl_context.h"

namespace lamina::ldni {

// A place, and the tag of what is there; less than 0 where nothing is.
struct TaggedPoint {
  float x = 0;
  float y = 0;
  float z = 0;
  float tag = -1;
};

class PointRaster {
 public:
  // clip_from_world  column-major, as OpenGL has it
  PointRaster(const GlPlatform& platform, unsigned width, unsigned height,
              const std::array<float, 16>& clip_from_world);
  ~PointRaster();
  PointRaster(const PointRaster&) = delete;
  PointRaster& operator=(const PointRaster&) = delete;

  // Draws triangles, three corners each. The tag is that of the last one.
  void draw(std::span<const TaggedPoint> corners);

  // Returns what each pixel shows: rows × columns, row-major, y down.
  std::vector<TaggedPoint> read();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::ldni
