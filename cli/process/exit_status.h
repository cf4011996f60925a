#pragma once
// How the program ends.

#include "compiler/validate.h"

namespace lamina::cli {

inline constexpr int kDone = 0;
inline constexpr int kFault = 1;  // of the design or of a file
inline constexpr int kUsageFault = 2;
inline constexpr int kInterrupted = 130;

// What it throws ends with kUsageFault.
using compiler::refuse_if;
using compiler::RequestError;

}  // namespace lamina::cli
