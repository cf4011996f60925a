// The module: text() by Fontconfig, HarfBuzz and FreeType.

#include "csg/text/detail/engine.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/utf8.h"
#include "csg/text/detail/font_cache.h"
#include "csg/text/detail/glyph_row.h"
#include "csg/text/detail/pen.h"

namespace lamina::text {
namespace {

std::vector<hb_codepoint_t> codes_of(const std::vector<Letter>& letters) {
  std::vector<hb_codepoint_t> codes;
  for (const Letter& letter : letters) {
    if (letter.code >= ' ') codes.push_back(letter.code);
  }
  return codes;
}

// "'愛' (U+611B), U+000A"
std::string list_of(const std::vector<Letter>& letters, std::string_view text) {
  constexpr std::size_t kMost = 4;
  std::string list;
  for (std::size_t i = 0; i < std::min(letters.size(), kMost); ++i) {
    const Letter& letter = letters[i];
    const std::string code = fmt::format("U+{:04X}", letter.code);
    if (i > 0) list += ", ";
    const std::string_view rest = text.substr(letter.at);
    list += letter.code < ' '
                ? code
                : fmt::format("'{}' ({})", rest.substr(0, utf8_length(rest[0])),
                              code);
  }
  if (letters.size() > kMost) {
    list += fmt::format(" and {} more", letters.size() - kMost);
  }
  return list;
}

class FontEngine : public Engine {
 public:
  explicit FontEngine(const FontFiles& files)
      : fonts_(FontCache::open(files)) {}

  AddedFont add_font(const char* path) noexcept override {
    try {
      return fonts_.add_font(path) ? AddedFont::kAdded : AddedFont::kNone;
    } catch (const std::exception&) {
      return AddedFont::kNoMemory;
    }
  }

  const Typeset* set(const csg::TextParams& params,
                     const Chords& chords) noexcept override {
    return typeset(params, [&](const Font& font, Typeset& result) {
      pen_ = Pen(params.size, chords);
      draw(params, font);
      result.points = pen_.points();
      result.ends = pen_.ends();
    });
  }

  const Typeset* measure_text(const csg::TextParams& params) noexcept override {
    return typeset(params, [&](const Font& font, Typeset& result) {
      const GlyphRow row = shape(params, font, messages_);
      result.text_metrics = measure(params, row, messages_);
    });
  }

  const Typeset* measure_font(const csg::TextParams& params) noexcept override {
    return typeset(params, [&](const Font& font, Typeset& result) {
      result.font_metrics = measure(params.size, font);
    });
  }

 private:
  // Finds the font and lets `work` fill the result with it.
  template <typename Work>
  const Typeset* typeset(const csg::TextParams& params,
                         const Work& work) noexcept {
    try {
      // The libraries below go on without what they have no memory for, and
      // the text would be another one. Few report it; malloc() does.
      errno = 0;
      messages_.clear();
      result_ = {};
      const Font& font = fonts_.find(std::string(params.font));
      if (!font.complaint.empty()) {
        messages_.push_back({Severity::kWarning, font.complaint});
      }
      result_.has_font = font.face != nullptr;
      if (result_.has_font) work(font, result_);
      result_.messages = messages_;
      return errno == ENOMEM ? nullptr : &result_;
    } catch (const std::exception&) {
      return nullptr;
    }
  }

  void draw(const csg::TextParams& params, const Font& font) {
    const GlyphRow row = shape(params, font, messages_);
    if (!row.missing.empty()) warn_of_missing(row, params.text, font);
    Vec2 place = align(params, row, messages_);
    for (const Glyph& glyph : row.glyphs) {
      auto& outline = reinterpret_cast<FT_OutlineGlyphRec_&>(*glyph.outline);
      pen_.draw(outline.outline, place + glyph.shift);
      place += glyph.advance;
    }
  }

  // OpenSCAD says nothing of them.
  void warn_of_missing(const GlyphRow& row, std::string_view text,
                       const Font& font) {
    const std::string all = fonts_.family_with(codes_of(row.letters));
    const std::string some =
        all.empty() ? fonts_.family_with(codes_of(row.missing)) : "";
    const char* const own = font.face->outlines->family_name;
    messages_.push_back(
        {Severity::kWarning,
         fmt::format(
             "Font '{}' cannot draw {}, and leaves a box or a gap; {}",
             own == nullptr ? "" : own, list_of(row.missing, text),
             !all.empty() ? fmt::format("font \"{}\" can", all)
             : !some.empty()
                 ? fmt::format("font \"{}\" can, but not the rest", some)
                 : "no font here can"),
         Audience::kTerminal});
  }

  FontCache fonts_;
  Pen pen_{1, {}};
  std::vector<Message> messages_;
  Typeset result_;
};

}  // namespace
}  // namespace lamina::text

extern "C" __attribute__((visibility("default"))) lamina::text::Engine*
lamina_make_text_engine(int version,
                        const lamina::text::FontFiles* files) noexcept {
  errno = 0;
  if (version != lamina::text::kEngineVersion) return nullptr;
  try {
    return new lamina::text::FontEngine(*files);
  } catch (const std::exception&) {
    errno = ENOMEM;
    return nullptr;
  }
}
