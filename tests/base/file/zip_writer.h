#pragma once
// Archives for tests.

#include <string>
#include <utility>
#include <vector>

namespace lamina::csg {

// The bytes of a ZIP archive of these entries (name, contents), deflated.
std::string make_zip(
    const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace lamina::csg
