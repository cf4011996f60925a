#include "csg/text/detail/glyph_row.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace lamina::text {
namespace {

// Characters of the first page of symbol fonts stand at U+F000.
constexpr hb_codepoint_t kSymbolPage = 0xF000;
constexpr hb_codepoint_t kPageSize = 0x100;

// What is no UTF-8 is read as a replacement character.
constexpr hb_codepoint_t kReplacement = 0xFFFD;

void move_to_symbol_page(hb_buffer_t* buffer, const std::string& text,
                         std::vector<Message>& messages) {
  unsigned count = 0;
  hb_glyph_info_t* characters = hb_buffer_get_glyph_infos(buffer, &count);
  for (unsigned i = 0; i < count; ++i) {
    hb_codepoint_t& character = characters[i].codepoint;
    if (character == kReplacement) {
      messages.push_back(
          {Severity::kWarning,
           fmt::format("Ignoring text with invalid UTF-8 encoding: \"{}\"",
                       text)});
      hb_buffer_set_length(buffer, 0);
      return;
    }
    if (character < kPageSize) character += kSymbolPage;
  }
}

// A string for C, which ends at its first zero.
std::string to_c(std::string_view text) {
  return std::string(text.substr(0, text.find('\0')));
}

Owned<hb_buffer_t> shape_text(const csg::TextParams& params, const Font& font,
                              std::vector<Message>& messages) {
  const std::string text = to_c(params.text);
  Owned<hb_buffer_t> owned(hb_buffer_create());
  hb_buffer_t* buffer = owned.get();
  hb_buffer_set_direction(
      buffer, hb_direction_from_string(to_c(params.direction).c_str(), -1));
  hb_buffer_set_script(buffer,
                       hb_script_from_string(to_c(params.script).c_str(), -1));
  hb_buffer_set_language(
      buffer, hb_language_from_string(to_c(params.language).c_str(), -1));
  hb_buffer_add_utf8(buffer, text.c_str(), -1, 0, -1);
  if (font.is_symbol) move_to_symbol_page(buffer, text, messages);
  hb_shape(font.shaper.get(), buffer, nullptr, 0);
  return owned;
}

// Null where the font has no such glyph, or only a picture of it.
OwnedGlyph load_glyph(const Font& font, FT_UInt index) {
  FT_Glyph glyph = nullptr;
  if (FT_Load_Glyph(font.face.get(), index, FT_LOAD_DEFAULT) != 0 ||
      FT_Get_Glyph(font.face->glyph, &glyph) != 0) {
    return nullptr;
  }
  OwnedGlyph owned(glyph);
  return glyph->format == FT_GLYPH_FORMAT_OUTLINE ? std::move(owned) : nullptr;
}

double horizontal_offset(std::string_view halign, double width,
                         std::vector<Message>& messages) {
  if (halign == "right") return -width;
  if (halign == "center") return -width / 2;
  if (halign != "left") {
    messages.push_back(
        {Severity::kPlain,
         fmt::format("Unknown value for the halign parameter (use \"left\", "
                     "\"right\" or \"center\"): '{}'",
                     halign)});
  }
  return 0;
}

double vertical_offset(std::string_view valign, double ascent, double descent,
                       std::vector<Message>& messages) {
  if (valign == "top") return -ascent;
  if (valign == "center") return descent / 2 - ascent / 2;
  if (valign == "bottom") return descent;
  if (valign != "baseline") {
    messages.push_back(
        {Severity::kPlain,
         fmt::format("Unknown value for the valign parameter (use "
                     "\"baseline\", \"bottom\", \"top\" or \"center\"): '{}'",
                     valign)});
  }
  return 0;
}

}  // namespace

GlyphRow shape(const csg::TextParams& params, const Font& font,
               std::vector<Message>& messages) {
  const Owned<hb_buffer_t> buffer = shape_text(params, font, messages);
  unsigned count = 0;
  const hb_glyph_info_t* infos =
      hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* places =
      hb_buffer_get_glyph_positions(buffer.get(), &count);
  GlyphRow row;
  row.is_horizontal =
      HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer.get()));
  for (unsigned i = 0; i < count; ++i) {
    Glyph glyph;
    glyph.outline = load_glyph(font, infos[i].codepoint);
    if (!glyph.outline) {
      messages.push_back(
          {Severity::kPlain,
           fmt::format("Could not load glyph {} for char at index {} in text "
                       "'{}'",
                       infos[i].codepoint, i, params.text)});
      continue;
    }
    FT_Glyph_Get_CBox(glyph.outline.get(), FT_GLYPH_BBOX_GRIDFIT, &glyph.box);
    glyph.shift = Vec2(places[i].x_offset, places[i].y_offset) * kUnscale;
    glyph.advance = Vec2(places[i].x_advance, places[i].y_advance) * kUnscale *
                    params.spacing;
    row.glyphs.push_back(std::move(glyph));
  }
  return row;
}

Vec2 align(const csg::TextParams& params, const GlyphRow& row,
           std::vector<Message>& messages) {
  double width = 0;
  double ascent = 0;
  double descent = 0;
  for (const Glyph& glyph : row.glyphs) {
    const FT_BBox& box = glyph.box;
    if (row.is_horizontal) {
      width += glyph.advance.x;
      ascent = std::max(ascent, static_cast<double>(box.yMax) * kUnscale);
      descent = std::max(descent, static_cast<double>(-box.yMin) * kUnscale);
    } else {
      width =
          std::max(width, static_cast<double>(box.xMax - box.xMin) * kUnscale);
      ascent += glyph.advance.y;
    }
  }
  return {horizontal_offset(params.halign, width, messages),
          vertical_offset(params.valign, ascent, descent, messages)};
}

}  // namespace lamina::text
