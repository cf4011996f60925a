#pragma once
// The texts of slicer/picture/viewer, which the build puts into the program.

#include <string_view>

namespace lamina::slicer {

// It has one each of {{title}}, {{head}}, {{tools}}, {{panel}} and {{tail}}.
extern const std::string_view kViewerPage;
extern const std::string_view kViewerStyle;
extern const std::string_view kViewerScript;

}  // namespace lamina::slicer
