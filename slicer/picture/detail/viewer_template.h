#pragma once
// The files of slicer/picture/viewer, as the build reads them.

#include <string_view>

namespace lamina::slicer {

// Has one each of {{title}}, {{style}}, {{script}}, {{facts}} and {{contours}}.
extern const std::string_view kViewerPage;
extern const std::string_view kViewerStyle;
extern const std::string_view kViewerScript;

}  // namespace lamina::slicer
