#pragma once
// The cases that measure conformance: the text tests of OpenSCAD's own suite as
// the package openscad-testing-data ships them, and all designs that come with
// OpenSCAD and its library MCAD.

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::conformance {

// A design, and what a program makes of it.
struct Case {
  std::string category;
  std::filesystem::path design;
  std::string format;                  // "echo", "csg" or "ast"
  std::vector<std::string> arguments;  // beside design and output
  // What OpenSCAD's suite expects; empty: the installed program decides.
  std::filesystem::path expectation;

  // "dumptest/cube-tests.csg".
  std::string name() const;
};

struct Suite {
  std::vector<Case> cases;  // category by category
  // Expectations whose design the package lacks: left over from tests that
  // OpenSCAD no longer has.
  std::vector<std::string> without_design;
};

// data    the folder that holds OpenSCAD's examples, libraries and test data
// throws  std::runtime_error where it holds no test data
Suite collect_suite(const std::filesystem::path& data);

}  // namespace lamina::conformance
