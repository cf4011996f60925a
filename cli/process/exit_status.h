#pragma once
// How the program ends.

namespace lamina::cli {

inline constexpr int kDone = 0;
inline constexpr int kFault = 1;  // of the design or of a file
inline constexpr int kUsageFault = 2;
inline constexpr int kInterrupted = 130;

}  // namespace lamina::cli
