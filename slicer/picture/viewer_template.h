#pragma once
// The page that shows a part, before it has one. `lamina view` puts style,
// script and part into it (slicer/picture/viewer_page.h); the studio links to
// them, and adds its form.

#include <string>
#include <string_view>

namespace lamina::slicer {

// HTML, but for the title.
struct ViewerPieces {
  std::string_view title = {};  // of the page, as text
  std::string_view head = {};   // the last of <head>: icon and style
  std::string_view tools = {};  // the header's, before those of the view
  std::string_view panel = {};  // the first of <main>, before solid and layer
  std::string_view tail = {};   // the last of <body>: the script
};

std::string viewer_html(const ViewerPieces& pieces);

std::string_view viewer_style();

// The classes that show a part; nothing of it runs by itself. startPage()
// begins the page of `lamina view`.
std::string_view viewer_script();

}  // namespace lamina::slicer
