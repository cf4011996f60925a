#include "slicer/picture/viewer_page.h"

#include <new>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "base/text.h"
#include "slicer/picture/viewer_template.h"

namespace lamina::slicer {
namespace {

std::string deflate(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();
  deflated.resize(size);
  return deflated;
}

std::string replaced(std::string_view text, char letter,
                     std::string_view replacement) {
  std::string result;
  for (const char c : text) {
    result += c == letter ? replacement : std::string_view(&c, 1);
  }
  return result;
}

}  // namespace

std::string viewer_page(const std::vector<Layer>& layers,
                        const ViewerOptions& options) {
  const ViewerPart part = viewer_part(layers, options);
  const std::string title = on_one_line(options.title);
  const std::string head =
      fmt::format("<link rel=\"icon\" href=\"data:,\">\n<style>\n{}\n</style>",
                  viewer_style());
  // JSON within a <script>, where no end tag may stand.
  const std::string facts = replaced(part.facts, '<', "\\u003c");
  const std::string tail = fmt::format(
      "<script type=\"application/json\" id=\"facts\">{}</script>\n"
      "<script type=\"text/plain\" id=\"contours\">{}</script>\n"
      "<script>\n{}\nstartPage();\n</script>",
      facts, base64(deflate(part.contours)), viewer_script());
  return viewer_html({.title = title, .head = head, .tail = tail});
}

}  // namespace lamina::slicer
