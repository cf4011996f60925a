#pragma once
// OpenGL's functions, found through a context, and its objects as values.
//
// An object deletes itself, so its context must be current at that time.

#include <functional>
#include <string>
#include <utility>

#include <GL/glcorearb.h>

#include "ldni/gl/gl_context.h"

namespace lamina::ldni {

// Every function in use: X(type, name).
#define LAMINA_GL_FUNCTIONS(X)                                 \
  X(PFNGLATTACHSHADERPROC, AttachShader)                       \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                           \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                         \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
  X(PFNGLBUFFERDATAPROC, BufferData)                           \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
  X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                     \
  X(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                   \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                     \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
  X(PFNGLCREATESHADERPROC, CreateShader)                       \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
  X(PFNGLDELETESHADERPROC, DeleteShader)                       \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                             \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                           \
  X(PFNGLENABLEPROC, Enable)                                   \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) \
  X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)       \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                           \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
  X(PFNGLGENTEXTURESPROC, GenTextures)                         \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
  X(PFNGLGETERRORPROC, GetError)                               \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
  X(PFNGLGETSTRINGPROC, GetString)                             \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                           \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
  X(PFNGLTEXPARAMETERIPROC, TexParameteri)                     \
  X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)               \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                           \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)         \
  X(PFNGLVIEWPORTPROC, Viewport)

struct GlFunctions {
#define LAMINA_GL_MEMBER(type, name) type name = nullptr;
  LAMINA_GL_FUNCTIONS(LAMINA_GL_MEMBER)
#undef LAMINA_GL_MEMBER
};

// Throws FileError if one is missing.
//
// find  null where a function does not exist
GlFunctions load_functions(
    const std::function<GlSymbol(const char* name)>& find);

// The owner of an object of OpenGL, known by its name. Empty after being moved
// from.
class GlObject {
 public:
  using Deleter = void (*)(const GlFunctions& gl, GLuint name);

  GlObject() = default;
  GlObject(const GlFunctions& gl, GLuint name, Deleter deleter)
      : gl_(&gl), name_(name), deleter_(deleter) {}
  GlObject(GlObject&& other) noexcept { swap(other); }
  GlObject& operator=(GlObject&& other) noexcept {
    swap(other);
    return *this;
  }
  ~GlObject() {
    if (name_ != 0) deleter_(*gl_, name_);
  }

  GLuint name() const { return name_; }

 private:
  void swap(GlObject& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    std::swap(deleter_, other.deleter_);
  }

  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
  Deleter deleter_ = nullptr;
};

GlObject make_buffer(const GlFunctions& gl);
GlObject make_framebuffer(const GlFunctions& gl);
GlObject make_texture(const GlFunctions& gl);
GlObject make_vertex_array(const GlFunctions& gl);
// Throws InternalError with the compiler's words if a shader is wrong.
GlObject make_program(const GlFunctions& gl, const std::string& vertex_shader,
                      const std::string& fragment_shader);

// Throws std::bad_alloc where memory ran out, InternalError for any other error
// of OpenGL.
void check_gl(const GlFunctions& gl);

}  // namespace lamina::ldni
