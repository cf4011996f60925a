#include "slicer/picture/viewer_template.h"

#include "base/check.h"
#include "base/text.h"
#include "slicer/picture/detail/viewer_texts.h"

namespace lamina::slicer {

std::string viewer_html(const ViewerPieces& pieces) {
  std::string page;
  std::string_view rest = kViewerPage;
  // Copies the template up to a mark, and a text in the mark's place.
  const auto put = [&](std::string_view mark, std::string_view text) {
    const std::size_t place = rest.find(mark);
    LAMINA_CHECK_EQ(place != std::string_view::npos, true);
    page.append(rest.substr(0, place)).append(text);
    rest.remove_prefix(place + mark.size());
  };
  put("{{title}}", escape_html(pieces.title));
  put("{{head}}", pieces.head);
  put("{{tools}}", pieces.tools);
  put("{{panel}}", pieces.panel);
  put("{{tail}}", pieces.tail);
  return page.append(rest);
}

std::string_view viewer_style() { return kViewerStyle; }

std::string_view viewer_script() { return kViewerScript; }

}  // namespace lamina::slicer
