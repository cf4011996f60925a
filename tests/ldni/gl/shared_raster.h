#pragma once
// A raster of faces that all tests of a process share: to make one takes longer
// than most tests.

#include <memory>

#include "ldni/gl/face_raster.h"

namespace lamina::ldni {

// Throws where OpenGL is missing: a test that needs it must fail.
std::unique_ptr<FaceRaster> shared_raster();

}  // namespace lamina::ldni
