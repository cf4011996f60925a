#pragma once
// What docs/conformance.md says; the tests hold it to its figures and
// exceptions.

#include <string>

namespace lamina::conformance {

bool page_has_line(const std::string& line);

// Whether it says anything of `name`, or lists it among the cases that may
// fail.
bool page_names(const std::string& name);
bool is_exception(const std::string& name);

}  // namespace lamina::conformance
