#include "serve/studio/page.h"

#include "serve/studio/detail/page_texts.h"
#include "slicer/picture/viewer_template.h"

namespace lamina::studio {

std::string page_html() {
  return slicer::viewer_html({.title = "lamina studio",
                              .head = R"(<link rel="icon" href="data:,">
<link rel="stylesheet" href="/studio.css">)",
                              .tools = kPageTools,
                              .panel = kPagePanel,
                              .tail = R"(<script src="/studio.js"></script>)"});
}

std::string page_style() {
  return std::string(slicer::viewer_style()).append(kPageStyle);
}

std::string page_script() {
  return std::string(slicer::viewer_script()).append(kPageScript);
}

}  // namespace lamina::studio
