#include "ldni/gl/face_raster.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "base/check.h"
#include "ldni/gl/detail/gl_functions.h"

namespace lamina::ldni {
namespace {

// Fragments of a picture, at most: 128 MiB.
constexpr std::size_t kMostFragments = 1U << 24;

// From pixels to the viewport, which begins a margin before the picture. All
// factors are powers of two: corners arrive as they were sent.
std::string vertex_shader() {
  return fmt::format(R"(#version 330 core
layout(location = 0) in vec3 corner;
void main() {{
  vec2 place = (corner.xy + {0}.0) / {1}.0 - 1.0;
  gl_Position = vec4(place, 2.0 * corner.z - 1.0, 1.0);
}}
)",
                     kPictureMargin, kViewportSize / 2);
}

// Colours are depth and face: the order of peeling. A pixel of which nothing is
// left keeps the greatest colour, behind which there is nothing. The shader
// writes the depth itself, so that it is compared as it is read back.
constexpr GLuint kNothing = 0xFFFFFFFF;
constexpr const char* kPeelShader = R"(#version 330 core
uniform usampler2D peeled;
out uvec2 nearest;
void main() {
  uint depth = floatBitsToUint(gl_FragCoord.z);
  uint side = gl_FrontFacing ? 1u : 0u;
  uint face = uint(gl_PrimitiveID) << 1 | side;
  uvec2 last = texelFetch(peeled, ivec2(gl_FragCoord.xy), 0).xy;
  if (depth < last.x || (depth == last.x && face <= last.y)) discard;
  nearest = uvec2(depth, face);
  gl_FragDepth = gl_FragCoord.z;
}
)";

class PeelingRaster final : public FaceRaster {
 public:
  explicit PeelingRaster(const GlPlatform& platform)
      : context_(platform.make_context()), gl_(context_->functions()) {
    const GlScope scope(*context_);
    corners_ = make_buffer(gl_);
    array_ = make_vertex_array(gl_);
    program_ = make_program(gl_, vertex_shader(), kPeelShader);
    depths_ = make_texture(gl_);
    for (Peel& peel : peels_) {
      peel = {make_texture(gl_), make_framebuffer(gl_)};
    }
    gl_.BindVertexArray(array_.name());
    gl_.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(RasterCorner),
                            nullptr);
    gl_.EnableVertexAttribArray(0);
    gl_.UseProgram(program_.name());
    gl_.Viewport(-kPictureMargin, -kPictureMargin, kViewportSize,
                 kViewportSize);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    check_gl(gl_);
  }
  ~PeelingRaster() override {
    // Objects delete themselves in their context.
    const GlScope scope(*context_);
    for (Peel& peel : peels_) peel = {};
    depths_ = {};
    program_ = {};
    array_ = {};
    corners_ = {};
  }

  bool draw(std::span<const RasterCorner> corners, int width, int height,
            std::vector<Fragment>& fragments) override {
    const GlScope scope(*context_);
    resize(width, height);
    gl_.BufferData(GL_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(corners.size_bytes()),
                   corners.data(), GL_STREAM_DRAW);
    corner_count_ = static_cast<GLsizei>(corners.size());
    clear(peels_[1], 0);
    const std::size_t begin = fragments.size();
    for (std::size_t pass = 0;; ++pass) {
      const std::size_t before = fragments.size();
      draw_peel(peels_[(pass + 1) % 2], peels_[pass % 2]);
      fetch(fragments);
      if (fragments.size() == before) return true;
      if (fragments.size() - begin > kMostFragments) {
        fragments.resize(begin);
        return false;
      }
    }
  }

 private:
  struct Peel {
    GlObject pixels;  // Pixel
    GlObject framebuffer;
  };
  struct Pixel {
    std::uint32_t depth;
    std::uint32_t face_and_side;
  };

  void resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    image_.resize(static_cast<std::size_t>(width) *
                  static_cast<std::size_t>(height));
    allocate(depths_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
    for (const Peel& peel : peels_) {
      allocate(peel.pixels, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT);
      gl_.BindFramebuffer(GL_FRAMEBUFFER, peel.framebuffer.name());
      gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                               GL_TEXTURE_2D, peel.pixels.name(), 0);
      gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                               GL_TEXTURE_2D, depths_.name(), 0);
    }
    check_gl(gl_);
    LAMINA_CHECK_EQ(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER),
                    static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
  }

  void allocate(const GlObject& texture, GLint kind, GLenum format,
                GLenum type) {
    gl_.BindTexture(GL_TEXTURE_2D, texture.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, kind, width_, height_, 0, format, type,
                   nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }

  void clear(const Peel& peel, GLuint colour) {
    const std::array<GLuint, 4> colours = {colour, colour, colour, colour};
    const GLfloat far = 1;
    gl_.BindFramebuffer(GL_FRAMEBUFFER, peel.framebuffer.name());
    gl_.ClearBufferuiv(GL_COLOR, 0, colours.data());
    gl_.ClearBufferfv(GL_DEPTH, 0, &far);
  }

  // Draws the nearest fragments behind those of `peeled`.
  void draw_peel(const Peel& peeled, const Peel& target) {
    clear(target, kNothing);
    gl_.BindTexture(GL_TEXTURE_2D, peeled.pixels.name());
    gl_.DrawArrays(GL_TRIANGLES, 0, corner_count_);
    check_gl(gl_);
  }

  void fetch(std::vector<Fragment>& fragments) {
    gl_.ReadPixels(0, 0, width_, height_, GL_RG_INTEGER, GL_UNSIGNED_INT,
                   image_.data());
    for (std::uint32_t pixel = 0; pixel < image_.size(); ++pixel) {
      const std::uint32_t face_and_side = image_[pixel].face_and_side;
      if (face_and_side != kNothing) {
        fragments.push_back({pixel, face_and_side});
      }
    }
  }

  std::unique_ptr<GlContext> context_;
  const GlFunctions& gl_;
  GlObject corners_;
  GlObject array_;
  GlObject program_;
  GlObject depths_;
  GLsizei corner_count_ = 0;
  std::array<Peel, 2> peels_;
  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> image_;  // as read back
};

}  // namespace

std::unique_ptr<FaceRaster> make_face_raster(const GlPlatform& platform) {
  return std::make_unique<PeelingRaster>(platform);
}

}  // namespace lamina::ldni
