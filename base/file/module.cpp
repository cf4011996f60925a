#include "base/file/module.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/auxv.h>

namespace lamina {

namespace fs = std::filesystem;

std::vector<std::string> module_folders() {
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) {
    // Where /proc is not mounted, the kernel has left the path that was run.
    const auto* run = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
    if (run != nullptr) program = fs::canonical(run, error);
  }
  if (error) return {};
  const fs::path folder = program.parent_path();
  return {folder.string(), (folder.parent_path() / LAMINA_MODULES).string()};
}

ModuleFunction find_in_module(const std::vector<std::string>& folders,
                              const std::string& module, const char* function,
                              const std::string& user) {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + module;
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    void* opened = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* address = opened ? dlsym(opened, function) : nullptr;
    if (address) return {address, {}};
    return {nullptr,
            fmt::format("Can't open the module for {}: {}", user, dlerror())};
  }
  return {nullptr, fmt::format("Can't find the module for {}, {}, in {}", user,
                               module, fmt::join(folders, " or "))};
}

}  // namespace lamina
