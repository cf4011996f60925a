#pragma once
// The texts of serve/studio/page, which the build puts into the program.

#include <string_view>

namespace lamina::studio {

extern const std::string_view kPageTools;   // buttons of the header
extern const std::string_view kPagePanel;   // beside the layers
extern const std::string_view kPageStyle;   // behind the viewer's
extern const std::string_view kPageScript;  // behind the viewer's

}  // namespace lamina::studio
