#pragma once
// Ways to draw with OpenGL, without a window: EGL on a graphics processor,
// OSMesa on the processor.
//
// Both libraries are opened when they are first needed and stay open: to link
// them would cost every start 14 ms and 50 MB. A renderer in software (Mesa's
// llvmpipe) is asked to start no threads: the layers are parallel already, and
// processor time is counted where it is spent.

#include <functional>
#include <memory>
#include <string>

namespace lamina::ldni {

struct GlFunctions;
using GlSymbol = void (*)();

// The version of OpenGL that is asked for.
inline constexpr int kGlMajor = 3;
inline constexpr int kGlMinor = 3;

// A context of OpenGL, with its objects. It is for one thread at a time, while
// a GlScope of that thread lives, and may outlive its platform.
class GlContext {
 public:
  virtual ~GlContext() = default;

  const GlFunctions& functions() const { return *functions_; }

 private:
  friend class GlPlatform;
  friend class GlScope;
  virtual void make_current() = 0;
  virtual void release() = 0;

  std::shared_ptr<const GlFunctions> functions_;
};

// Makes a context current in the calling thread while it lives.
class GlScope {
 public:
  explicit GlScope(GlContext& context);
  ~GlScope();
  GlScope(const GlScope&) = delete;
  GlScope& operator=(const GlScope&) = delete;

 private:
  GlContext& context_;
};

// Where contexts come from. Any thread may ask for one.
class GlPlatform {
 public:
  virtual ~GlPlatform() = default;

  // Throws FileError where there is no context of that version with the
  // precision that a sampler needs.
  std::unique_ptr<GlContext> make_context() const;

 protected:
  // Finds a function of OpenGL; null where no function has that name.
  using Finder = std::function<GlSymbol(const char* name)>;

 private:
  virtual std::unique_ptr<GlContext> create() const = 0;
  virtual Finder finder() const = 0;
};

// The name of what draws: "llvmpipe (LLVM 15.0.6, 256 bits)".
std::string renderer_name(GlContext& context);

// Opens the best platform: EGL on a graphics processor that has the version,
// else OSMesa. Throws FileError, with the package that is missing, where
// neither can be opened. To be called before threads are started: it may set
// LP_NUM_THREADS.
std::shared_ptr<const GlPlatform> open_gl();

// Both throw FileError where there is no such platform.
std::shared_ptr<const GlPlatform> open_osmesa();
enum class EglDevice { kHardware, kAny };
std::shared_ptr<const GlPlatform> open_egl(EglDevice device);

}  // namespace lamina::ldni
