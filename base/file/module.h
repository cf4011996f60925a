#pragma once
// Modules: parts of the program that it opens when they are first needed, since
// the libraries that they are linked with are slow to load.
//
// A module has one C function, and what it gives and takes is declared once for
// both sides. It stays open to the end: libraries keep state of their own that
// outlives their callers.

#include <array>
#include <string>
#include <vector>

namespace lamina {

// The files of all modules.
inline constexpr const char* kTextModule = "lamina_text.so";
inline constexpr const char* kDecimationModule = "lamina_decimate.so";
inline constexpr std::array kModules = {kTextModule, kDecimationModule};

// The folders of the program's modules: its own, or, where it is installed,
// lib/lamina beside that.
std::vector<std::string> module_folders();

struct ModuleFunction {
  void* address = nullptr;  // null: there is a fault
  std::string fault;
};

// The function of a module in the first of the folders that has the module.
//
// user  what the module is for, in words of messages: "text()"
ModuleFunction find_in_module(const std::vector<std::string>& folders,
                              const std::string& module, const char* function,
                              const std::string& user);

}  // namespace lamina
