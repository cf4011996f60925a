#pragma once
// Modules: shared libraries of the program's own, opened on first use, so that
// what few designs need costs no other run anything.
//
// A module links a package plainly and holds all code that calls it. It offers
// one C function, which makes an engine: an object behind an abstract class
// that both sides know. Nothing is thrown across the border; results report
// failures.

#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace lamina {

struct Module {
  const char* file;      // "lamina_text.so"
  const char* function;  // makes an engine; null, with errno, if it does not
  const char* purpose;   // "text()", for messages
  const char* hint;      // what helps where it is missing; "" if nothing does
};

// The folders of the program's modules: its own, or, where it is installed,
// lib/lamina beside that.
std::vector<std::string> module_folders();

// The module's function. The module stays open to the end: the libraries below
// it keep state of their own that outlives their callers.
//
// folders      where to look, in this order
// diagnostics  gets what is thrown, too
// throws       GeometryError where the module is missing or cannot be opened
void* open_module(const Module& module, const std::vector<std::string>& folders,
                  Diagnostics& diagnostics);

// For a module whose function made no engine: throws std::bad_alloc if `error`
// (errno) is ENOMEM, or GeometryError as the module is of another version.
[[noreturn]] void fail_without_engine(const Module& module, int error,
                                      Diagnostics& diagnostics);

}  // namespace lamina
