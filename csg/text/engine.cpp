// The module: text() by Fontconfig, HarfBuzz and FreeType.

#include "csg/text/detail/engine.h"

#include <exception>
#include <vector>

#include "csg/text/detail/font_cache.h"
#include "csg/text/detail/glyph_row.h"
#include "csg/text/detail/pen.h"

namespace lamina::text {
namespace {

class FontEngine : public Engine {
 public:
  bool add_font(const char* path) noexcept override {
    return fonts_.add_font(path);
  }

  const Typeset* set(const csg::TextParams& params,
                     int segments) noexcept override {
    try {
      messages_.clear();
      pen_ = Pen(params.size, segments);
      draw(params);
      result_ = {pen_.points(), pen_.ends(), messages_};
      return &result_;
    } catch (const std::exception&) {
      return nullptr;
    }
  }

 private:
  void draw(const csg::TextParams& params) {
    const Font& font = fonts_.find(std::string(params.font));
    if (!font.complaint.empty()) {
      messages_.push_back({Severity::kWarning, font.complaint});
    }
    if (!font.face) return;
    const GlyphRow row = shape(params, font, messages_);
    Vec2 place = align(params, row, messages_);
    for (const Glyph& glyph : row.glyphs) {
      auto& outline = reinterpret_cast<FT_OutlineGlyphRec_&>(*glyph.outline);
      pen_.draw(outline.outline, place + glyph.shift);
      place += glyph.advance;
    }
  }

  FontCache fonts_;
  Pen pen_{1, 1};
  std::vector<Message> messages_;
  Typeset result_;
};

}  // namespace
}  // namespace lamina::text

extern "C" __attribute__((visibility("default"))) lamina::text::Engine*
lamina_make_text_engine(int version) noexcept {
  if (version != lamina::text::kEngineVersion) return nullptr;
  try {
    return new lamina::text::FontEngine();
  } catch (const std::exception&) {
    return nullptr;
  }
}
