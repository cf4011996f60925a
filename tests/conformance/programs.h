#pragma once
// The two programs that are compared, run on one case.

#include <filesystem>
#include <string>

#include "tests/conformance/suite.h"

namespace lamina::conformance {

// What a program wrote, as OpenSCAD's suite compares it: without time stamps
// and folders of files, without blank lines at the ends.
std::string normalized(std::string text);

// The output that lamina writes; "" if it writes none.
std::string run_lamina(const Case& one);

// The same for the installed openscad. Kept in `cache` under the program's
// version, the design's text and the arguments.
//
// throws  std::runtime_error where openscad is missing
class OpenScad {
 public:
  explicit OpenScad(std::filesystem::path cache);
  std::string run(const Case& one) const;

 private:
  std::filesystem::path cache_;
  std::string version_;
};

}  // namespace lamina::conformance
