#include "base/file/module.h"

#include <cerrno>
#include <filesystem>
#include <new>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/auxv.h>

namespace lamina {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& words, const std::string& hint,
                       Diagnostics& diagnostics) {
  Diagnostic error{Severity::kError, {}, words};
  error.hints = hint_of(hint);
  diagnostics.report(error);
  throw GeometryError(std::move(error));
}

// Libraries set themselves up as they are opened, and throw what is their own
// where there is no memory for it.
void* open_library(const std::string& path) {
  try {
    return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  } catch (...) {
    throw std::bad_alloc();
  }
}

}  // namespace

std::vector<std::string> module_folders() {
  std::error_code error;
  // In the portable archive (scripts/portable) it is the loader, which lies
  // beside the program.
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) {
    // Where /proc is not mounted, the kernel has left the path that was run.
    // NOLINTNEXTLINE(performance-no-int-to-ptr) ; so the kernel hands it over
    const auto* run = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
    if (run != nullptr) program = fs::canonical(run, error);
  }
  if (error) return {};
  const fs::path folder = program.parent_path();
  return {folder.string(), (folder.parent_path() / LAMINA_MODULES).string()};
}

void* open_module(const Module& module, const std::vector<std::string>& folders,
                  Diagnostics& diagnostics) {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + module.file;
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    void* const library = open_library(path);
    void* symbol = library ? dlsym(library, module.function) : nullptr;
    if (symbol) return symbol;
    fail(fmt::format("Can't open the module for {}: {}", module.purpose,
                     dlerror()),
         "", diagnostics);
  }
  fail(fmt::format("Can't find the module for {}, {}, in {}", module.purpose,
                   module.file, fmt::join(folders, " or ")),
       module.hint, diagnostics);
}

void fail_without_engine(const Module& module, int error,
                         Diagnostics& diagnostics) {
  if (error == ENOMEM) throw std::bad_alloc();
  fail(fmt::format("{} is of another version", module.file), "", diagnostics);
}

}  // namespace lamina
