// OSMesa and EGL, and where their libraries are found.

#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include "base/diagnostic.h"
#include "ldni/gl/gl_context.h"

namespace lamina::ldni {
namespace {

[[noreturn]] void fail(const std::string& words) { throw FileError(words); }

// A shared library. It stays open, as the libraries below it keep state.
class Library {
 public:
  // Opens the first one of `names` that exists.
  Library(std::initializer_list<const char*> names, const char* package) {
    std::string reason;
    for (const char* const name : names) {
      library_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (library_ != nullptr) return;
      if (reason.empty()) reason = dlerror();
    }
    fail(fmt::format("Can't open OpenGL: {}. Install the package {}.", reason,
                     package));
  }

  template <typename Function>
  void load(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    if (function == nullptr) fail(fmt::format("{} is missing", name));
  }

 private:
  void* library_ = nullptr;
};

// --- OSMesa -----------------------------------------------------------------

struct OsMesaFunctions {
  OsMesaFunctions()
      : library({"libOSMesa.so.8", "libOSMesa.so.6"}, "libosmesa6") {
    library.load(create, "OSMesaCreateContextAttribs");
    library.load(destroy, "OSMesaDestroyContext");
    library.load(make_current, "OSMesaMakeCurrent");
    library.load(find, "OSMesaGetProcAddress");
  }

  Library library;
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) find = nullptr;
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext(std::shared_ptr<const OsMesaFunctions> osmesa,
                OSMesaContext context)
      : osmesa_(std::move(osmesa)), context_(context) {}
  ~OsMesaContext() override { osmesa_->destroy(context_); }

 private:
  void make_current() override {
    if (osmesa_->make_current(context_, window_.data(), GL_UNSIGNED_BYTE, 1,
                              1) == GL_FALSE) {
      fail("OSMesa can't draw");
    }
  }
  void release() override {
    osmesa_->make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  }

  std::shared_ptr<const OsMesaFunctions> osmesa_;
  OSMesaContext context_;
  // OSMesa needs a picture to draw in; nothing is drawn in this one.
  std::array<unsigned char, 4> window_{};
};

class OsMesaPlatform final : public GlPlatform {
 private:
  std::unique_ptr<GlContext> create() const override {
    const std::array<int, 11> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            kGlMajor,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            kGlMinor,
                                            0};
    const OSMesaContext context = osmesa_->create(attributes.data(), nullptr);
    if (context == nullptr) {
      fail(fmt::format("OSMesa has no OpenGL {}.{}", kGlMajor, kGlMinor));
    }
    return std::make_unique<OsMesaContext>(osmesa_, context);
  }
  Finder finder() const override {
    return [this](const char* name) { return osmesa_->find(name); };
  }

  std::shared_ptr<const OsMesaFunctions> osmesa_ =
      std::make_shared<const OsMesaFunctions>();
};

// --- EGL --------------------------------------------------------------------

struct EglFunctions {
  EglFunctions() : library({"libEGL.so.1"}, "libegl1") {
    library.load(find, "eglGetProcAddress");
    library.load(bind_api, "eglBindAPI");
    library.load(create_context, "eglCreateContext");
    library.load(destroy_context, "eglDestroyContext");
    library.load(initialize, "eglInitialize");
    library.load(make_current, "eglMakeCurrent");
    find_extension(query_devices, "eglQueryDevicesEXT");
    find_extension(query_device_string, "eglQueryDeviceStringEXT");
    find_extension(get_platform_display, "eglGetPlatformDisplayEXT");
  }

  template <typename Function>
  void find_extension(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(find(name));
    if (function == nullptr) fail(fmt::format("EGL lacks {}", name));
  }

  Library library;
  decltype(&eglGetProcAddress) find = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
};

class EglContext final : public GlContext {
 public:
  EglContext(std::shared_ptr<const EglFunctions> egl, EGLDisplay display,
             EGLContext context)
      : egl_(std::move(egl)), display_(display), context_(context) {}
  ~EglContext() override { egl_->destroy_context(display_, context_); }

 private:
  void make_current() override {
    egl_->bind_api(EGL_OPENGL_API);
    if (egl_->make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE,
                           context_) == EGL_FALSE) {
      fail("EGL can't draw");
    }
  }
  void release() override {
    egl_->make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE,
                       EGL_NO_CONTEXT);
  }

  std::shared_ptr<const EglFunctions> egl_;
  EGLDisplay display_;
  EGLContext context_;
};

// One display of one device.
class EglPlatform final : public GlPlatform {
 public:
  EglPlatform(std::shared_ptr<const EglFunctions> egl, EGLDisplay display)
      : egl_(std::move(egl)), display_(display) {}

 private:
  std::unique_ptr<GlContext> create() const override {
    const std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,
        kGlMajor,
        EGL_CONTEXT_MINOR_VERSION,
        kGlMinor,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_NONE};
    egl_->bind_api(EGL_OPENGL_API);
    const EGLContext context = egl_->create_context(
        display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) {
      fail(fmt::format("EGL has no OpenGL {}.{}", kGlMajor, kGlMinor));
    }
    return std::make_unique<EglContext>(egl_, display_, context);
  }
  Finder finder() const override {
    return [this](const char* name) { return egl_->find(name); };
  }

  std::shared_ptr<const EglFunctions> egl_;
  EGLDisplay display_;
};

bool has_word(const char* text, std::string_view word) {
  return text != nullptr &&
         std::string_view(text).find(word) != std::string_view::npos;
}

// Whether the context draws in software: Mesa also does so where the driver of
// a device is missing.
bool is_software(GlContext& context) {
  const std::string name = renderer_name(context);
  return has_word(name.c_str(), "llvmpipe") ||
         has_word(name.c_str(), "softpipe") || has_word(name.c_str(), "SWR");
}

std::vector<EGLDeviceEXT> list_devices(const EglFunctions& egl) {
  EGLint count = 0;
  if (egl.query_devices(0, nullptr, &count) == EGL_FALSE) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  egl.query_devices(count, devices.data(), &count);
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

// Returns null where `device` is not of the wanted kind.
std::shared_ptr<const GlPlatform> open_device(
    const std::shared_ptr<const EglFunctions>& egl, EGLDeviceEXT device,
    EglDevice wanted) {
  const bool wants_hardware = wanted == EglDevice::kHardware;
  if (wants_hardware &&
      has_word(egl->query_device_string(device, EGL_EXTENSIONS),
               "EGL_MESA_device_software")) {
    return nullptr;
  }
  const EGLDisplay display =
      egl->get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  if (egl->initialize(display, nullptr, nullptr) == EGL_FALSE) return nullptr;
  auto platform = std::make_shared<EglPlatform>(egl, display);
  try {
    const auto context = platform->make_context();
    if (wants_hardware && is_software(*context)) return nullptr;
  } catch (const FileError&) {
    return nullptr;
  }
  return platform;
}

}  // namespace

std::shared_ptr<const GlPlatform> open_osmesa() {
  return std::make_shared<OsMesaPlatform>();
}

std::shared_ptr<const GlPlatform> open_egl(EglDevice device) {
  const auto egl = std::make_shared<const EglFunctions>();
  for (const EGLDeviceEXT candidate : list_devices(*egl)) {
    if (auto platform = open_device(egl, candidate, device)) {
      return platform;
    }
  }
  fail(fmt::format("EGL has no device with OpenGL {}.{}", kGlMajor, kGlMinor));
}

}  // namespace lamina::ldni
