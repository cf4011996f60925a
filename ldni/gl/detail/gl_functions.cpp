#include "ldni/gl/detail/gl_functions.h"

#include <array>
#include <new>

#include <fmt/format.h>

#include "base/diagnostic.h"

namespace lamina::ldni {
namespace {

[[noreturn]] void fail_internally(const std::string& words) {
  throw InternalError(words);
}

// A shader that is attached lives as long as its program.
void attach_shader(const GlFunctions& gl, GLuint program, GLenum kind,
                   const std::string& text) {
  const GlObject shader(
      gl, gl.CreateShader(kind),
      [](const GlFunctions& f, GLuint name) { f.DeleteShader(name); });
  const char* const source = text.c_str();
  gl.ShaderSource(shader.name(), 1, &source, nullptr);
  gl.CompileShader(shader.name());
  gl.AttachShader(program, shader.name());
}

}  // namespace

GlFunctions load_functions(
    const std::function<GlSymbol(const char* name)>& find) {
  GlFunctions gl;
  const auto load = [&find](auto& function, const char* name) {
    using Function = std::remove_reference_t<decltype(function)>;
    function = reinterpret_cast<Function>(find(name));
    if (function != nullptr) return;
    throw FileError(fmt::format("OpenGL lacks {}", name));
  };
#define LAMINA_GL_LOAD(type, name) load(gl.name, "gl" #name);
  LAMINA_GL_FUNCTIONS(LAMINA_GL_LOAD)
#undef LAMINA_GL_LOAD
  return gl;
}

GlObject make_buffer(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return {gl, name,
          [](const GlFunctions& f, GLuint n) { f.DeleteBuffers(1, &n); }};
}

GlObject make_framebuffer(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return {gl, name,
          [](const GlFunctions& f, GLuint n) { f.DeleteFramebuffers(1, &n); }};
}

GlObject make_texture(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  return {gl, name,
          [](const GlFunctions& f, GLuint n) { f.DeleteTextures(1, &n); }};
}

GlObject make_vertex_array(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return {gl, name,
          [](const GlFunctions& f, GLuint n) { f.DeleteVertexArrays(1, &n); }};
}

GlObject make_program(const GlFunctions& gl, const std::string& vertex_shader,
                      const std::string& fragment_shader) {
  GlObject program(
      gl, gl.CreateProgram(),
      [](const GlFunctions& f, GLuint name) { f.DeleteProgram(name); });
  attach_shader(gl, program.name(), GL_VERTEX_SHADER, vertex_shader);
  attach_shader(gl, program.name(), GL_FRAGMENT_SHADER, fragment_shader);
  gl.LinkProgram(program.name());
  GLint is_linked = 0;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &is_linked);
  if (is_linked != 0) return program;
  std::array<char, 2000> log{};
  gl.GetProgramInfoLog(program.name(), log.size(), nullptr, log.data());
  fail_internally(fmt::format("a shader does not link: {}", log.data()));
}

void check_gl(const GlFunctions& gl) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
  fail_internally(fmt::format("OpenGL error 0x{:x}", error));
}

}  // namespace lamina::ldni
