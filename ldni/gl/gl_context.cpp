#include "ldni/gl/gl_context.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "ldni/gl/detail/gl_functions.h"
#include "ldni/gl/face_raster.h"

namespace lamina::ldni {
namespace {

// Throws FileError where OpenGL lacks the precision that makes corners exact
// (face_raster.h). Every driver of this century has it.
void require_precision(const GlFunctions& gl) {
  GLint bits = 0;
  std::array<GLint, 2> viewport{};
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &bits);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  const auto [width, height] = viewport;
  if (bits >= kSubPixelBits && std::min(width, height) >= kViewportSize) return;
  throw FileError(
      fmt::format("OpenGL draws too coarsely: {} bits below a pixel, {} by {} "
                  "pixels",
                  bits, width, height));
}

}  // namespace

GlScope::GlScope(GlContext& context) : context_(context) {
  context_.make_current();
}

GlScope::~GlScope() { context_.release(); }

std::unique_ptr<GlContext> GlPlatform::make_context() const {
  std::unique_ptr<GlContext> context = create();
  const GlScope scope(*context);
  context->functions_ =
      std::make_shared<const GlFunctions>(load_functions(finder()));
  require_precision(context->functions());
  return context;
}

std::string renderer_name(GlContext& context) {
  const GlScope scope(context);
  const GLubyte* const name = context.functions().GetString(GL_RENDERER);
  return name == nullptr ? "" : reinterpret_cast<const char*>(name);
}

std::shared_ptr<const GlPlatform> open_gl() {
  setenv("LP_NUM_THREADS", "0", 0);
  try {
    return open_egl(EglDevice::kHardware);
  } catch (const FileError&) {
    return open_osmesa();
  }
}

}  // namespace lamina::ldni
