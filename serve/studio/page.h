#pragma once
// The studio's page: the viewer's (slicer/picture/viewer), with a panel for the
// parameters and what belongs to it (serve/studio/page).

#include <string>

namespace lamina::studio {

// "/", "/studio.css" and "/studio.js".
std::string page_html();
std::string page_style();
std::string page_script();

}  // namespace lamina::studio
