#pragma once
// Evaluating a program for a test.

#include <string>

#include "parser/language.h"

namespace lamina::csg {

// What a program says and makes, as openscad's `.echo` and `.csg` hold it.
struct Evaluated {
  std::string echo;
  std::string csg;
  std::string terminal;  // caret form, echoes left out
};

// Evaluates on a thread with a stack of `stack_bytes`.
Evaluated evaluate_text(const std::string& text,
                        std::size_t stack_bytes = std::size_t{256} << 20,
                        Language language = Language::k2021);
Evaluated evaluate_file(const std::string& path);

// The file's content; empty if there is none.
std::string read_text(const std::string& path);

}  // namespace lamina::csg
