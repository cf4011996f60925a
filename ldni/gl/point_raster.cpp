#include "ldni/gl/point_raster.h"

#include "ldni/gl/detail/gl_functions.h"

namespace lamina::ldni {
namespace {

// Rows are read from the bottom up: what is up is drawn down.
constexpr const char* kVertexShader = R"(#version 330 core
uniform mat4 clip_from_world;
layout(location = 0) in vec4 corner;
out vec3 place;
flat out float tag;
void main() {
  place = corner.xyz;
  tag = corner.w;
  gl_Position = clip_from_world * vec4(corner.xyz, 1.0);
  gl_Position.y = -gl_Position.y;
}
)";

constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 place;
flat in float tag;
out vec4 point;
void main() {
  point = vec4(place, tag);
}
)";

}  // namespace

struct PointRaster::State {
  State(const GlPlatform& platform, unsigned width_in, unsigned height_in)
      : context(platform.make_context()),
        gl(context->functions()),
        width(static_cast<GLsizei>(width_in)),
        height(static_cast<GLsizei>(height_in)) {}

  // A texture as large as the picture, attached to it.
  GlObject attach(GLenum place, GLint internal, GLenum format) const {
    GlObject texture = make_texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format,
                  GL_FLOAT, nullptr);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D,
                            texture.name(), 0);
    return texture;
  }

  void make_picture() {
    picture = make_framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, picture.name());
    points = attach(GL_COLOR_ATTACHMENT0, GL_RGBA32F, GL_RGBA);
    depths =
        attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
    gl.Viewport(0, 0, width, height);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    const std::array<float, 4> nothing = {0, 0, 0, -1};
    const float farthest = 1;
    gl.ClearBufferfv(GL_COLOR, 0, nothing.data());
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
  }

  void make_corners() {
    corners = make_buffer(gl);
    array = make_vertex_array(gl);
    gl.BindVertexArray(array.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, corners.name());
    gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(TaggedPoint),
                           nullptr);
    gl.EnableVertexAttribArray(0);
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  GLsizei width;
  GLsizei height;
  GlObject picture;
  GlObject points;
  GlObject depths;
  GlObject corners;
  GlObject array;
  GlObject program;
};

PointRaster::PointRaster(const GlPlatform& platform, unsigned width,
                         unsigned height,
                         const std::array<float, 16>& clip_from_world)
    : state_(std::make_unique<State>(platform, width, height)) {
  const GlFunctions& gl = state_->gl;
  const GlScope scope(*state_->context);
  state_->make_picture();
  state_->make_corners();
  state_->program = make_program(gl, kVertexShader, kFragmentShader);
  gl.UseProgram(state_->program.name());
  gl.UniformMatrix4fv(
      gl.GetUniformLocation(state_->program.name(), "clip_from_world"), 1,
      GL_FALSE, clip_from_world.data());
  check_gl(gl);
}

PointRaster::~PointRaster() {
  const GlScope scope(*state_->context);
  state_->program = {};
  state_->array = {};
  state_->corners = {};
  state_->depths = {};
  state_->points = {};
  state_->picture = {};
}

void PointRaster::draw(std::span<const TaggedPoint> corners) {
  const GlScope scope(*state_->context);
  state_->gl.BufferData(GL_ARRAY_BUFFER,
                        static_cast<GLsizeiptr>(corners.size_bytes()),
                        corners.data(), GL_STREAM_DRAW);
  state_->gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
  check_gl(state_->gl);
}

std::vector<TaggedPoint> PointRaster::read() {
  const GlScope scope(*state_->context);
  std::vector<TaggedPoint> points(static_cast<std::size_t>(state_->width) *
                                  static_cast<std::size_t>(state_->height));
  state_->gl.ReadPixels(0, 0, state_->width, state_->height, GL_RGBA, GL_FLOAT,
                        points.data());
  check_gl(state_->gl);
  return points;
}

}  // namespace lamina::ldni
