#pragma once
// Runs the two programs that are compared on one case.

#include <string>

#include "tests/conformance/suite.h"

namespace lamina::conformance {

// What a program wrote, as OpenSCAD's suite compares it: without time stamps
// and folders of files, without blank lines at the ends.
std::string normalized(std::string text);

// The output that a program writes, run in the cache's folder; "" if it writes
// none.
std::string run_lamina(const Case& one);
std::string run_openscad(const Case& one);

}  // namespace lamina::conformance
